// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_scene.h"

#include <span>
#include <utility>

#include "trajectory/blocks/bytes.h"

namespace noli::report {
namespace {

std::string cells_of(const Mesh& mesh) {
  std::string bytes;
  const auto put_cell = [&](std::span<const VertexId> cell) {
    for (const VertexId v : cell) put(bytes, std::uint32_t{v});
  };
  for (const auto& face : mesh.faces) put_cell(face);
  for (const auto& edge : mesh.edges) put_cell(edge);
  put_cell(mesh.points);
  return bytes;
}

}  // namespace

void put_scene(const ReportScene& scene, PackedFrames frames, ReportPage& report) {
  Json parts = Json::array();
  for (const ReportPart& part : scene.parts) {
    parts.push_back({{"name", part.name}, {"first", part.first}, {"vertices", part.vertices}, {"fixed", part.fixed}});
    if (part.given) parts.back()["given"] = true;
  }
  const Mesh& mesh = scene.mesh;
  report.page["scene"] = {
      {"dimension", scene.dimension},
      {"vertices", mesh.vertex_count},
      {"cells", {{"faces", mesh.faces.size()}, {"edges", mesh.edges.size()}, {"points", mesh.points.size()}}},
      {"parts", parts},
      {"frames", frames.times.size()},
      {"times", frames.times},
      {"unit", scene.unit},
      {"least", frames.least},
      {"greatest", frames.greatest},
      {"steps", {{"begin", scene.begin}, {"list", scene.ends}}},
      {"note", scene.note}};
  report.cells = packed(cells_of(mesh));
  report.motion = std::move(frames.motion);
}

}  // namespace noli::report
