// SPDX-License-Identifier: Apache-2.0
//
// The features of a mesh for contact: which pairs can meet, each found from exactly one pair of cells.
//
// Notation
//   cell    a face, loose edge or loose point, as in include/noli/mesh.h
//   owner   of a vertex or edge: the first cell that has it; of a face: itself. A pair of features belongs to the pair
//           of their owners
//
// Pairs in space: vertex and face, edge and edge, loose point and loose edge, two loose points; and for two loose edges
// with a common vertex, the other end of one against the other edge (any other vertex of an edge against an edge is
// part of edge and edge, or of vertex and face). In the plane: vertex and edge, two loose points. Features with a
// common vertex are not a pair.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "certificates/stencil.h"

namespace noli::certificates {

class Features {
 public:
  struct Cell {
    std::array<VertexId, 3> vertices{};
    std::uint8_t size = 0;            ///< 3: a face, 2: a loose edge, 1: a loose point
    std::uint8_t owned_vertices = 0;  ///< bit k: owns vertices[k]
    std::uint8_t owned_edges = 0;     ///< bit k: owns the edge from vertices[k] to vertices[(k + 1) % size]
    std::array<std::uint32_t, 3> edges{};

    std::span<const VertexId> all() const { return {vertices.data(), size}; }  ///< its vertices
    std::size_t edge_count() const { return size == 3 ? 3 : size == 2 ? 1 : 0; }
  };

  /// Throws std::invalid_argument for 2^31 features or more.
  Features(const Mesh& mesh, int dimension);

  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<std::array<VertexId, 2>>& edges() const { return edges_; }

  /// Cells of a vertex, ascending.
  std::span<const std::uint32_t> cells_of(VertexId v) const {
    return {cell_list_.data() + cells_of_[v], cells_of_[v + 1] - cells_of_[v]};
  }

  /// Calls each(Stencil) for the pairs that belong to cells a and b, a != b. Precondition: valid cells.
  template <class Each>
  void for_each_pair(std::uint32_t a, std::uint32_t b, Each&& each) const {
    vertices_and_whole(cells_[a], b, each);
    vertices_and_whole(cells_[b], a, each);
    if (cells_[a].size == 1 && cells_[b].size == 1) points(a, b, each);
    if (dimension_ == 3 && cells_[a].size == 2 && cells_[b].size == 2) loose_neighbours(cells_[a], cells_[b], each);
    if (dimension_ == 3) edges_and_edges(cells_[a], cells_[b], each);
  }

 private:
  /// Owned vertices of one cell against another cell, if that is a face (an edge in the plane); or against a loose
  /// edge, if the vertex is a loose point.
  template <class Each>
  void vertices_and_whole(const Cell& a, std::uint32_t b, Each&& each) const {
    const Cell& whole = cells_[b];
    if (dimension_ == 3 && whole.size == 3) {
      for_each_owned(a, [&](VertexId v) {
        if (has(whole, v)) return;
        each(Stencil{FeaturePair::vertex_face,
                     {v, whole.vertices[0], whole.vertices[1], whole.vertices[2]},
                     pair_key(FeaturePair::vertex_face, v, b)});
      });
    }
    if (dimension_ == 3 && !(whole.size == 2 && a.size == 1)) return;
    for_each_owned(a, [&](VertexId v) { vertex_and_edges(v, whole, each); });
  }

  /// The pairs of two loose edges with one vertex in common: the other end of each against the other edge.
  template <class Each>
  void loose_neighbours(const Cell& a, const Cell& b, Each&& each) const {
    for (std::size_t k = 0; k < 2; ++k) {
      if (!has(b, a.vertices[k]) && has(b, a.vertices[1 - k])) vertex_and_edges(a.vertices[k], b, each);
      if (!has(a, b.vertices[k]) && has(a, b.vertices[1 - k])) vertex_and_edges(b.vertices[k], a, each);
    }
  }

  template <class Each>
  void vertex_and_edges(VertexId v, const Cell& whole, Each&& each) const {
    for_each_owned_edge(whole, [&](std::uint32_t e) {
      const auto& [p, q] = edges_[e];
      if (v == p || v == q) return;
      each(Stencil{FeaturePair::vertex_edge, {v, p, q, 0}, pair_key(FeaturePair::vertex_edge, v, e)});
    });
  }

  template <class Each>
  void points(std::uint32_t a, std::uint32_t b, Each&& each) const {
    const VertexId v = std::min(cells_[a].vertices[0], cells_[b].vertices[0]);
    const VertexId w = std::max(cells_[a].vertices[0], cells_[b].vertices[0]);
    if (v != w) each(Stencil{FeaturePair::vertex_vertex, {v, w, 0, 0}, pair_key(FeaturePair::vertex_vertex, v, w)});
  }

  template <class Each>
  void edges_and_edges(const Cell& a, const Cell& b, Each&& each) const {
    for_each_owned_edge(a, [&](std::uint32_t e) {
      for_each_owned_edge(b, [&](std::uint32_t f) {
        const auto &p = edges_[std::min(e, f)], &q = edges_[std::max(e, f)];
        if (p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1]) return;
        each(Stencil{FeaturePair::edge_edge,
                     {p[0], p[1], q[0], q[1]},
                     pair_key(FeaturePair::edge_edge, std::min(e, f), std::max(e, f))});
      });
    });
  }

  template <class Each>
  void for_each_owned(const Cell& cell, Each&& each) const {
    for (std::uint8_t k = 0; k < cell.size; ++k) {
      if (cell.owned_vertices >> k & 1) each(cell.vertices[k]);
    }
  }
  template <class Each>
  void for_each_owned_edge(const Cell& cell, Each&& each) const {
    for (std::uint8_t k = 0; k < cell.size; ++k) {
      if (cell.owned_edges >> k & 1) each(cell.edges[k]);
    }
  }
  static bool has(const Cell& cell, VertexId v) {
    for (std::uint8_t k = 0; k < cell.size; ++k) {
      if (cell.vertices[k] == v) return true;
    }
    return false;
  }

  void add_cells(const Mesh& mesh);
  void number_edges(std::size_t vertex_count);
  void list_cells(std::size_t vertex_count);

  int dimension_;
  std::vector<Cell> cells_;
  std::vector<std::array<VertexId, 2>> edges_;
  std::vector<std::size_t> cells_of_;
  std::vector<std::uint32_t> cell_list_;
};

}  // namespace noli::certificates
