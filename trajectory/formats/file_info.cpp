// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/file_info.h"

#include <algorithm>

#include "trajectory/cells.h"
#include "trajectory/formats/frame_look.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/ply_header.h"
#include "trajectory/formats/polygons.h"
#include "trajectory/merge.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

std::string ply_format_name(PlyFormat format) {
  switch (format) {
    case PlyFormat::ascii: return "PLY ASCII";
    case PlyFormat::binary_little_endian: return "PLY binary little-endian";
    case PlyFormat::binary_big_endian: return "PLY binary big-endian";
  }
  return "";
}

std::size_t count_mesh_edges(const Mesh& mesh) {
  std::vector<std::array<VertexId, 2>> edges;
  edges.reserve(3 * mesh.faces.size());
  for (const auto& f : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back({std::min(f[i], f[(i + 1) % 3]), std::max(f[i], f[(i + 1) % 3])});
  }
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) {
    end_if_stopped();
    return a < b;
  });
  const auto end = std::unique(edges.begin(), edges.end());
  return static_cast<std::size_t>(end - edges.begin()) + mesh.edges.size();
}

std::optional<BoundingBox> bounding_box(const std::vector<Position>& positions) {
  if (positions.empty()) return std::nullopt;
  BoundingBox box{positions[0], positions[0]};
  for (const Position& x : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(box.lower[axis], x[axis]);
      box.upper[axis] = std::max(box.upper[axis], x[axis]);
    }
  }
  return box;
}

std::size_t count_degenerate_faces(const Frame& frame) {
  const auto& x = frame.positions;
  return static_cast<std::size_t>(std::count_if(frame.mesh.faces.begin(), frame.mesh.faces.end(), [&](const auto& f) {
    end_if_stopped();
    return has_zero_area(x[f[0]], x[f[1]], x[f[2]]);
  }));
}

std::size_t count_coincident_vertices(const std::vector<Position>& positions) {
  IdenticalVertices classes(positions.size());
  classes.refine(positions);
  return classes.merged_count();
}

}  // namespace

FileInfo describe_frame(const Frame& frame) {
  FileInfo info;
  info.vertices = frame.mesh.vertex_count;
  info.faces = frame.mesh.faces.size();
  info.mesh_edges = count_mesh_edges(frame.mesh);
  info.loose_edges = frame.mesh.edges.size();
  info.loose_points = frame.mesh.points.size();
  info.unreferenced_vertices = unreferenced_vertices(frame.mesh).size();
  info.degenerate_faces = count_degenerate_faces(frame);
  info.coincident_vertices = count_coincident_vertices(frame.positions);
  info.box = bounding_box(frame.positions);
  info.planar = all_z_equal(frame.positions);
  return info;
}

FileInfo describe_file(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path);
  FileInfo info = describe_frame(parse_frame(bytes, path));
  if (!bytes.starts_with("ply")) {  // an OBJ file that begins with "ply" has been refused
    info.format = mesh_format(path) == MeshFormat::vtk ? "VTK" : "OBJ";
    info.number_type = info.format == "VTK" ? look_at_frame(bytes, path).facts.numbers : "decimal";
    return info;
  }
  const PlyHeader header = parse_ply_header(bytes, path.string());
  info.format = ply_format_name(header.format);
  info.number_type = number_type(*header.find("vertex"));  // parse_frame has checked that it is there
  return info;
}

}  // namespace noli
