// SPDX-License-Identifier: Apache-2.0
// Certifies each step inside a solver's loop, and stops at the first step in which something touches.
#include <cstdio>
#include <vector>

#include <noli/sequence.h>

int main() {
  noli::Mesh mesh;
  mesh.vertex_count = 4;
  mesh.faces = {{0, 1, 2}};
  mesh.points = {3};  // a particle that falls on the triangle
  std::vector<noli::Position> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1}};
  double velocity = 0;
  const double h = 0.1;

  noli::SequenceVerifier verifier(mesh, {});
  verifier.add(x);
  for (int step = 1; step <= 100; ++step) {
    velocity -= 9.81 * h;
    x[3][2] += h * velocity;
    const auto result = verifier.add(x);
    if (!result->touches()) continue;
    std::printf("step %d is rejected: contact at t = %g of it\n", step, result->first->time);
    return 0;
  }
  return 1;
}
