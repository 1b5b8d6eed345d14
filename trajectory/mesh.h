// SPDX-License-Identifier: Apache-2.0
//
// What a set of vertices is joined to: the cells of a mesh, by vertex index. No coordinates (see frames.h,
// world_lines.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace noli {

using VertexId = std::uint32_t;
/// Coordinates in the file's own unit of length. The same type as the kernel's point in three dimensions.
using Position = std::array<double, 3>;

/// Cells of a mesh. A *cell* is a face, a loose edge or a loose point: what the file lists. Its features are its
/// vertices, edges and itself. Cells are numbered in this order: faces, then edges, then points. Invariant (checked by
/// the readers): every index is below vertex_count. An index may occur twice in a cell: it is degenerate.
struct Mesh {
  std::size_t vertex_count = 0;
  std::vector<std::array<VertexId, 3>> faces;
  std::vector<std::array<VertexId, 2>> edges;  ///< loose edges: those the file lists as lines, not the edges of faces
  std::vector<VertexId> points;                ///< loose points: those the file lists as points

  std::size_t cell_count() const { return faces.size() + edges.size() + points.size(); }
  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// A mesh at one moment.
struct Frame {
  Mesh mesh;
  std::vector<Position> positions;  ///< one per vertex; z = 0 where the file has none
};

}  // namespace noli
