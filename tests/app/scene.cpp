// SPDX-License-Identifier: Apache-2.0
#include "tests/app/scene.h"

#include <fmt/format.h>

#include "trajectory/formats/write_ply.h"

namespace noli::app_tests {

std::string ply_text(const std::vector<Position>& points, const std::vector<std::array<VertexId, 3>>& faces) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face "
      "{}\n"
      "property list uchar int vertex_indices\nend_header\n",
      points.size(), faces.size());
  for (const Position& p : points) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const auto& face : faces) text += fmt::format("3 {} {} {}\n", face[0], face[1], face[2]);
  return text;
}

std::string two_triangles(double height) {
  return ply_text({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, height}, {1.5, 1, height}, {1, 1.5, height}},
                  {{0, 1, 2}, {3, 4, 5}});
}

std::string sail_through_deck() {
  return ply_text({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {2, 2, -1}, {2, 2, 1}, {3, 2, 2}}, {{0, 1, 2}, {3, 4, 5}});
}

std::string sheets(std::size_t faces, double height) {
  std::size_t side = 1;
  while (4 * side * side < faces) ++side;
  Frame frame;
  for (const double z : {height, height + 1}) {
    const auto base = static_cast<VertexId>(frame.positions.size()), row = static_cast<VertexId>(side + 1);
    for (VertexId j = 0; j <= side; ++j) {
      for (VertexId i = 0; i <= side; ++i) {
        frame.positions.push_back({double(i), double(j), z + 0.125 * double(i * j % 3)});
        const VertexId corner = base + j * row + i;
        if (i < side && j < side) frame.mesh.faces.push_back({corner, corner + 1, corner + row});
        if (i < side && j < side) frame.mesh.faces.push_back({corner + 1, corner + row + 1, corner + row});
      }
    }
  }
  frame.mesh.vertex_count = frame.positions.size();
  return format_ply(frame, PlyEncoding::binary_little_endian);
}

}  // namespace noli::app_tests
