// SPDX-License-Identifier: Apache-2.0
// Certifies frames that are in memory: a triangle that falls past a corner of a resting one.
#include <cstdio>
#include <vector>

#include <noli/sequence.h>

int main() {
  noli::Mesh mesh;
  mesh.vertex_count = 6;
  mesh.faces = {{0, 1, 2}, {3, 4, 5}};
  const auto frame = [](double x, double z) {
    return std::vector<noli::Position>{
        {0, 0, 0},    {1, 0, 0},        {0, 1, 0},          // at rest
        {x, 0.25, z}, {x, 0.75, z + 1}, {x, 0.25, z + 1}};  // with its lowest corner at (x, 0.25, z)
  };

  for (const double x : {1.25, 0.25}) {
    noli::SequenceVerifier verifier(mesh, {});
    verifier.add(frame(x, 1));
    const auto step = verifier.add(frame(x, -1));
    if (step->first) {
      std::printf("x = %g: %s contact at t = %g of the step\n", x, noli::name(step->first->kind).data(),
                  step->first->time);
    } else {
      std::printf("x = %g: nothing touches\n", x);
    }
  }
}
