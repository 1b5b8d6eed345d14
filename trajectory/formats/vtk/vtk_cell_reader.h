// SPDX-License-Identifier: Apache-2.0
//
// Cells as VTK stores them: types, corners one after another, and where each cell ends.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>
#include "trajectory/formats/polygons.h"

namespace noli {

/// vtkCellType.h, those that are read.
enum VtkCell : std::int64_t {
  vtk_empty = 0,
  vtk_vertex = 1,
  vtk_poly_vertex = 2,
  vtk_line = 3,
  vtk_poly_line = 4,
  vtk_triangle = 5,
  vtk_triangle_strip = 6,
  vtk_polygon = 7,
  vtk_pixel = 8,
  vtk_quad = 9
};

/// The kinds of cells of polygonal data. `type`: that of all cells of the kind.
struct VtkKind {
  const char *xml, *count, *hdf;  ///< its element and the attribute with its number in XML; its group in HDF5
  std::size_t column;             ///< its place among the offsets of a step in HDF5
  VtkCell type;
};
constexpr std::array<VtkKind, 4> vtk_kinds = {{{"Verts", "NumberOfVerts", "Vertices", 0, vtk_poly_vertex},
                                               {"Lines", "NumberOfLines", "Lines", 1, vtk_poly_line},
                                               {"Strips", "NumberOfStrips", "Strips", 3, vtk_triangle_strip},
                                               {"Polys", "NumberOfPolys", "Polygons", 2, vtk_polygon}}};

/// Adds cells to a mesh, piece by piece.
class VtkCellReader {
 public:
  /// A fault of these cells: throws.
  using Fail = std::function<void(const std::string& message)>;

  /// `polygons`: what to do with those, and where they are noted; nullptr: they are cut, unnoted.
  VtkCellReader(Mesh& mesh, Polygons* polygons) : mesh_(mesh), polygons_(polygons) {}

  /// Points are numbered within their piece: point 0 of the next cells is this vertex of the mesh.
  void begin_piece(std::size_t first_vertex) { first_ = first_vertex; }

  /// Adds the cells of a list. `corners`: of all cells; `ends[i]`: where the corners of cell i end; types: one for each
  /// cell, or a single one for all. Calls `fail` where a cell is impossible, or of a type that is not read; Stopped.
  /// Precondition: mesh.vertex_count is set.
  void add(std::span<const std::int64_t> types, std::span<const std::int64_t> corners,
           std::span<const std::int64_t> ends, const Fail& fail);

 private:
  void gather(std::span<const std::int64_t> corners, const Fail& fail);
  void add_cell(std::size_t number, std::int64_t type, const Fail& fail);
  void add_face(std::size_t number, const Fail& fail);

  Mesh& mesh_;
  Polygons* polygons_;
  std::size_t first_ = 0;
  std::vector<VertexId> cell_;
};

}  // namespace noli
