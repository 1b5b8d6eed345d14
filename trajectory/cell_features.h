// SPDX-License-Identifier: Apache-2.0
//
// The features of cells, and which cell owns each vertex and edge, so that each pair of features is counted once.
//
// Notation
//   corner   a place in a cell's list of vertices; edge i of a face goes from corner i to corner i + 1, cyclically
//   owner    of a vertex, or of an edge as a pair of vertex ids: the least cell that has it (with `yields`, see
//            find_owners). A pair of features is examined with the pair of its owners
//   listed   a face or loose edge, if no earlier cell of its kind has the same vertices
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <noli/mesh.h>

namespace noli {

/// A set of features of one cell: bits 0, 1, 2 its corners, 3, 4, 5 its edges, 6 the cell itself.
using FeatureMask = std::uint8_t;
constexpr FeatureMask corner_bit(int corner) { return static_cast<FeatureMask>(1 << corner); }
constexpr FeatureMask edge_bit(int edge) { return static_cast<FeatureMask>(8 << edge); }
constexpr FeatureMask cell_bit = 64;

/// For each cell, which of its features belong to it.
struct CellFeatures {
  std::vector<FeatureMask> owned;   ///< the corners and edges it owns; cell_bit if it is listed
  std::vector<FeatureMask> shared;  ///< the corners and edges that another cell has too
};

/// Number of corners of a cell: 3 (a face), 2 (a loose edge) or 1 (a loose point).
inline int corner_count(const Mesh& mesh, std::uint32_t cell) {
  if (cell < mesh.faces.size()) return 3;
  return cell < mesh.faces.size() + mesh.edges.size() ? 2 : 1;
}

/// The corners of a cell; a loose edge or point repeats its last one.
inline std::array<VertexId, 3> corners(const Mesh& mesh, std::uint32_t cell) {
  const std::size_t faces = mesh.faces.size(), edges = mesh.edges.size();
  if (cell < faces) return mesh.faces[cell];
  if (cell < faces + edges)
    return {mesh.edges[cell - faces][0], mesh.edges[cell - faces][1], mesh.edges[cell - faces][1]};
  const VertexId v = mesh.points[cell - faces - edges];
  return {v, v, v};
}

/// The corners of a cell in ascending order; a loose edge or point repeats its last one.
std::array<VertexId, 3> ascending(std::array<VertexId, 3> v, int count);

/// Finds the owners. With `list_cells` (for a strict verification) also marks listed cells; otherwise none is. A vertex
/// or edge that a cell has twice counts once, at its first place. Time and memory are linear in the mesh (if no vertex
/// has more than a few cells).
///
/// `yields`: whether each cell yields; empty: none does. A cell that yields owns a vertex or edge only if all cells
/// with it yield. So if pairs of yielding cells are not compared, a pair of features still belongs to a pair of cells
/// that is compared, if there is one.
CellFeatures find_owners(const Mesh& mesh, bool list_cells, const std::vector<bool>& yields = {});

}  // namespace noli
