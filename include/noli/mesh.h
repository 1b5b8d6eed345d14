// SPDX-License-Identifier: Apache-2.0
//
// A moving mesh: its cells by vertex index, its positions, and the pairs of cells that are not compared.
//
//   noli::Mesh mesh;
//   mesh.vertex_count = 4;
//   mesh.faces = {{0, 1, 2}};   // one triangle
//   mesh.points = {3};          // and a particle
//
// Notation
//   vertex   an index below vertex_count. Vertices are identified by index; equal positions do not merge them
//   cell     a face, a loose edge or a loose point: what a file lists. Its features are its vertices, edges and itself.
//            Cells are numbered in this order: faces, then edges, then points
//
// Units: coordinates have whatever unit of length the caller uses. They are taken as they are, without rounding.
// Thread safety: plain values; several threads may read one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace noli {

using VertexId = std::uint32_t;
/// Coordinates x, y, z. The same type as a query's point in three dimensions.
using Position = std::array<double, 3>;

/// Cells of a mesh, without coordinates. Invariant (readers check it): every index is below vertex_count. A cell that
/// lists an index twice is degenerate, which is allowed.
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

/// Pairs of cells that are not compared: those between two groups of vertices, or within one group.
struct Exclusions {
  using Pair = std::array<std::uint16_t, 2>;

  std::vector<std::uint16_t> groups;  ///< of each vertex; all vertices of a cell have one group. Empty without pairs
  std::vector<Pair> pairs;            ///< {a, b} with a <= b, ascending, each once

  bool empty() const { return pairs.empty(); }
  bool excluded(std::uint16_t a, std::uint16_t b) const {
    return std::binary_search(pairs.begin(), pairs.end(), Pair{std::min(a, b), std::max(a, b)});
  }
  friend bool operator==(const Exclusions&, const Exclusions&) = default;
};

}  // namespace noli
