// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/vtk/vtk_cell_reader.h"

#include <fmt/format.h>

#include <utility>

#include "trajectory/cells.h"
#include "trajectory/stop.h"

namespace noli {

void VtkCellReader::add(std::span<const std::int64_t> types, std::span<const std::int64_t> corners,
                        std::span<const std::int64_t> ends, const Fail& fail) {
  std::int64_t begin = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (i % 4096 == 0) end_if_stopped();
    const std::int64_t end = ends[i];
    if (end < begin || end > static_cast<std::int64_t>(corners.size())) {
      fail(fmt::format("cell {} ends at {} of {} corners", i, end, corners.size()));
    }
    gather(corners.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)), fail);
    add_cell(i, types.size() == 1 ? types[0] : types[i], fail);
    begin = end;
  }
  if (begin != static_cast<std::int64_t>(corners.size())) {
    fail(fmt::format("the last cell ends at {} of {} corners", begin, corners.size()));
  }
}

void VtkCellReader::gather(std::span<const std::int64_t> corners, const Fail& fail) {
  cell_.clear();
  const auto there = static_cast<std::int64_t>(mesh_.vertex_count - first_);
  for (const std::int64_t v : corners) {
    if (v < 0 || v >= there) fail(fmt::format("a cell has point {}; expected 0 to {}", v, there - 1));
    cell_.push_back(static_cast<VertexId>(first_ + static_cast<std::size_t>(v)));
  }
}

void VtkCellReader::add_cell(std::size_t number, std::int64_t type, const Fail& fail) {
  const auto require = [&](bool holds) {
    if (!holds) fail(fmt::format("cell {} of type {} has {} points", number, type, cell_.size()));
  };
  const std::span<const VertexId> c(cell_);
  switch (type) {
    case vtk_empty: return;
    case vtk_vertex: require(c.size() == 1); return add_polygon(mesh_, c);
    case vtk_poly_vertex:
      for (std::size_t i = 0; i < c.size(); ++i) add_polygon(mesh_, c.subspan(i, 1));
      return;
    case vtk_line: require(c.size() == 2); return add_polygon(mesh_, c);
    case vtk_poly_line:
      require(c.size() >= 2);
      for (std::size_t i = 0; i + 1 < c.size(); ++i) add_polygon(mesh_, c.subspan(i, 2));
      return;
    case vtk_triangle: require(c.size() == 3); return add_polygon(mesh_, c);
    case vtk_triangle_strip:
      require(c.size() >= 3);
      for (std::size_t i = 0; i + 2 < c.size(); ++i) {
        const std::size_t odd = i % 2;  // every other one is the other way round
        add_polygon(mesh_, std::array{c[i], c[i + 1 + odd], c[i + 2 - odd]});
      }
      return;
    case vtk_polygon: require(c.size() >= 3); return add_face(number, fail);
    case vtk_quad: require(c.size() == 4); return add_face(number, fail);
    case vtk_pixel:
      require(c.size() == 4);
      std::swap(cell_[2], cell_[3]);
      return add_face(number, fail);
    default:
      fail(
          fmt::format("cell {} has type {}; expected points, lines, triangles or polygons (in ParaView: Extract "
                      "Surface, Triangulate)",
                      number, type));
  }
}

void VtkCellReader::add_face(std::size_t number, const Fail& fail) {
  if (cell_.size() > 3 && polygons_ != nullptr) {
    if (polygons_->rule == PolygonRule::refuse) fail(fmt::format("cell {}: {}", number, refused_polygon(cell_.size())));
    polygons_->fans.push_back({mesh_.faces.size(), cell_.size() - 2});
  }
  add_polygon(mesh_, cell_);
}

}  // namespace noli
