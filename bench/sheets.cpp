// SPDX-License-Identifier: Apache-2.0
#include "bench/sheets.h"

#include <cstdint>

namespace noli::bench {
namespace {

/// In [0, 1), a multiple of 2^-20 that looks random (the finaliser of MurmurHash3).
double roughness(std::uint64_t number) {
  number ^= number >> 33;
  number *= 0xff51afd7ed558ccdULL;
  number ^= number >> 33;
  number *= 0xc4ceb9fe1a85ec53ULL;
  number ^= number >> 33;
  return static_cast<double>(number >> 44) / 1048576.0;
}

void add_faces(Mesh& mesh, std::size_t side) {
  const auto base = static_cast<VertexId>(mesh.vertex_count), row = static_cast<VertexId>(side + 1);
  for (VertexId j = 0; j < side; ++j) {
    for (VertexId i = 0; i < side; ++i) {
      const VertexId corner = base + j * row + i;
      mesh.faces.push_back({corner, corner + 1, corner + row});
      mesh.faces.push_back({corner + 1, corner + row + 1, corner + row});
    }
  }
  mesh.vertex_count += (side + 1) * (side + 1);
}

/// A sheet at height z at both times, before the common fall.
void add_sheet(Step& step, std::size_t side, double z_t0, double z_t1) {
  constexpr double bumps = 0.25, shift = 0.375, fall = 20;
  add_faces(step.mesh, side);
  for (std::size_t j = 0; j <= side; ++j) {
    for (std::size_t i = 0; i <= side; ++i) {
      const double x = static_cast<double>(i), y = static_cast<double>(j), rough = bumps * roughness(step.x_t0.size());
      step.x_t0.push_back({x, y, z_t0 + rough});
      step.x_t1.push_back({x + shift, y, z_t1 + rough - fall});
    }
  }
}

}  // namespace

Step falling_sheets(std::size_t faces) {
  std::size_t side = 1;
  while (4 * side * side < faces) ++side;
  Step step;
  add_sheet(step, side, 0, 0);
  add_sheet(step, side, 1, 0.225);
  return step;
}

}  // namespace noli::bench
