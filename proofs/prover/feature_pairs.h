// SPDX-License-Identifier: Apache-2.0
//
// The pairs of features of two cells, as sets, and the exact decision of one pair.
//
// Notation
//   a, b       two different cells; a_i, b_j their corners; e_i the edge of a face from corner i to corner i + 1
//   PairSet    bits. In 3D: i (0 to 2) a_i against the face b; 3 + j: b_j against the face a; 8 + 3 i + j: edge i of a
//              against edge j of b. In both: 20 + 3 i + j: a_i against edge j of b; 29 + 3 j + i: b_j against edge i of
//              a; 40 + 3 i + j: a_i against b_j
//
// proofs/prover/verifier.h defines which pairs of features count. The last kind, and in 3D the last two, are pairs that
// may be left over (proofs/prover/cells/leftover.h).
//
// It does not check whether features share vertices: the parts must have none in common (proofs/prover/cell_pair.h).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include <noli/contact.h>
#include "proofs/prover/cells/direction.h"
#include "proofs/prover/cells/moving_cell.h"

namespace noli {

using PairSet = std::uint64_t;

namespace detail {

constexpr unsigned vertex_edge_shift = 20, edge_vertex_shift = 29, vertex_vertex_shift = 40;

/// The edges whose two ends are in a part: bit i for edge i.
constexpr unsigned edges_in(CornerMask part) {
  constexpr std::array<std::uint8_t, 8> table = {0, 0, 0, 1, 0, 4, 2, 7};
  return table[part];
}

/// Bit 3 i + j for each i in rows and j in columns.
constexpr PairSet product(PairSet rows, PairSet columns) {
  return ((rows & 1) != 0 ? columns : 0) | ((rows & 2) != 0 ? columns << 3 : 0) | ((rows & 4) != 0 ? columns << 6 : 0);
}

constexpr PairSet vertex_edge_set(unsigned a_corners, unsigned a_edges, unsigned b_corners, unsigned b_edges) {
  return product(a_corners, b_edges) << vertex_edge_shift | product(b_corners, a_edges) << edge_vertex_shift;
}

/// The pairs of the given corners and edges of a with those of b that count in any case (not only when left over). A
/// face is present if `a_face` or `b_face`.
template <int Dim>
PairSet pair_set(unsigned a_corners, unsigned a_edges, bool a_face, unsigned b_corners, unsigned b_edges, bool b_face) {
  if constexpr (Dim == 3) {
    return (b_face ? a_corners : 0) | (a_face ? b_corners << 3 : 0) | product(a_edges, b_edges) << 8;
  } else {
    return vertex_edge_set(a_corners, a_edges, b_corners, b_edges);
  }
}

/// A set of small pairs without duplicates.
class SmallPairs {
 public:
  void add(const SmallPair& pair, unsigned bit) {
    if (std::find(known_.begin(), known_.begin() + size_, pair) != known_.begin() + size_) return;
    known_[static_cast<std::size_t>(size_++)] = pair;
    set_ |= PairSet{1} << bit;
  }
  PairSet set() const { return set_; }

 private:
  std::array<SmallPair, 27> known_{};
  int size_ = 0;
  PairSet set_ = 0;
};

inline void add_vertex_edge(const CellShape& a, const CellShape& b, unsigned shift, SmallPairs& pairs) {
  for (unsigned i = 0; i < a.corners; ++i) {
    for (unsigned j = 0; j < b.edge_count(); ++j) {
      if (!leaves_vertex_edge(a, a.vertices[i], b, b.edge(j))) continue;
      pairs.add(vertex_edge_pair(a.vertices[i], b.edge(j)), shift + 3 * i + j);
    }
  }
}

/// The small pairs that a and b leave over. Precondition: few_vertices(a, b).
template <int Dim>
[[gnu::noinline]] PairSet left_over(const CellShape& a, const CellShape& b) {
  SmallPairs pairs;
  if constexpr (Dim == 3) {
    add_vertex_edge(a, b, vertex_edge_shift, pairs);
    add_vertex_edge(b, a, edge_vertex_shift, pairs);
  }
  for (unsigned i = 0; i < a.corners; ++i) {
    for (unsigned j = 0; j < b.corners; ++j) {
      if (!leaves_vertex_vertex(a, a.vertices[i], b, b.vertices[j])) continue;
      pairs.add(vertex_vertex_pair(a.vertices[i], b.vertices[j]), vertex_vertex_shift + 3 * i + j);
    }
  }
  return pairs.set();
}

}  // namespace detail

/// All pairs of a feature on the corners a_part of a with a feature on the corners b_part of b.
template <int Dim>
PairSet pairs_within(const CellIndices& a, CornerMask a_part, const CellIndices& b, CornerMask b_part) {
  const bool a_whole = a_part == all_corners(a.corners), b_whole = b_part == all_corners(b.corners);
  const unsigned a_edges = detail::edges_in(a_part), b_edges = detail::edges_in(b_part);
  return detail::pair_set<Dim>(a_part, a_edges, a_whole && a.corners == 3, b_part, b_edges, b_whole && b.corners == 3) |
         detail::vertex_edge_set(a_part, a_edges, b_part, b_edges) |
         detail::product(a_part, b_part) << detail::vertex_vertex_shift;
}

/// The pairs of features that belong to this pair of cells, and those that may: other cells may leave over the same
/// pairs (Leftovers::counted_at decides).
template <int Dim>
PairSet pairs_owned(const CellIndices& a, const CellIndices& b) {
  const PairSet pairs = detail::pair_set<Dim>(a.owned & 7, a.owned >> 3 & 7, a.corners == 3, b.owned & 7,
                                              b.owned >> 3 & 7, b.corners == 3);
  const CellShape a_shape = shape_of(a), b_shape = shape_of(b);
  return few_vertices(a_shape, b_shape) ? pairs | detail::left_over<Dim>(a_shape, b_shape) : pairs;
}

/// One feature of a cell, by its corners; the first `size` count.
struct Feature {
  std::array<std::uint8_t, 3> corners{};
  std::uint8_t size = 0;
};

constexpr Feature corner_feature(unsigned i) { return {{static_cast<std::uint8_t>(i)}, 1}; }
constexpr Feature edge_feature(unsigned i) {
  return {{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i == 2 ? 0 : i + 1)}, 2};
}
constexpr Feature face_feature = {{0, 1, 2}, 3};

/// A pair of features, in the order of include/noli/query.h.
template <int Dim>
struct FeatureQuestion {
  FeaturePair pair;
  const MovingCell<Dim>* first_cell;
  Feature first;
  const MovingCell<Dim>* second_cell;
  Feature second;

  std::array<VertexId, 4> vertices() const {
    std::array<VertexId, 4> v{};
    for (std::size_t i = 0; i < first.size; ++i) v[i] = first_cell->vertices[first.corners[i]];
    for (std::size_t i = 0; i < second.size; ++i) v[first.size + i] = second_cell->vertices[second.corners[i]];
    return v;
  }
};

/// The pair of features of the lowest bit of a set. Precondition: the set is not empty.
template <int Dim>
FeatureQuestion<Dim> first_of(PairSet set, const MovingCell<Dim>& a, const MovingCell<Dim>& b) {
  using Question = FeatureQuestion<Dim>;
  const auto bit = static_cast<unsigned>(std::countr_zero(set));
  if (bit < 3) return Question{FeaturePair::vertex_face, &a, corner_feature(bit), &b, face_feature};
  if (bit < 6) return Question{FeaturePair::vertex_face, &b, corner_feature(bit - 3), &a, face_feature};
  const auto row_and_column = [bit](unsigned shift) { return std::pair((bit - shift) / 3, (bit - shift) % 3); };
  if (bit < detail::vertex_edge_shift) {
    const auto [i, j] = row_and_column(8);
    return Question{FeaturePair::edge_edge, &a, edge_feature(i), &b, edge_feature(j)};
  }
  if (bit < detail::edge_vertex_shift) {
    const auto [i, j] = row_and_column(detail::vertex_edge_shift);
    return Question{FeaturePair::vertex_edge, &a, corner_feature(i), &b, edge_feature(j)};
  }
  if (bit < detail::vertex_vertex_shift) {
    const auto [j, i] = row_and_column(detail::edge_vertex_shift);
    return Question{FeaturePair::vertex_edge, &b, corner_feature(j), &a, edge_feature(i)};
  }
  const auto [i, j] = row_and_column(detail::vertex_vertex_shift);
  return Question{FeaturePair::vertex_vertex, &a, corner_feature(i), &b, corner_feature(j)};
}

/// Whether the pair of the lowest bit of a set is counted at these cells. Precondition: the set is not empty, and part
/// of pairs_owned(a, b).
template <int Dim>
bool counted_here(PairSet set, const MovingCell<Dim>& a, const MovingCell<Dim>& b, const Leftovers& leftovers) {
  const auto question = first_of(set, a, b);
  const auto v = question.vertices();
  if (question.pair == FeaturePair::vertex_vertex) {
    return leftovers.counted_at(vertex_vertex_pair(v[0], v[1]), a.cell, b.cell);
  }
  if (Dim == 2 || question.pair != FeaturePair::vertex_edge) return true;
  return leftovers.counted_at(vertex_edge_pair(v[0], {v[1], v[2]}), a.cell, b.cell);
}

/// Calls ask<Pair, Dim>() with the kind of pair and the dimension.
template <class Ask>
auto with_pair(FeaturePair pair, int dimension, const Ask& ask) {
  using enum FeaturePair;
  switch (pair) {
    case vertex_face: return ask.template operator()<vertex_face, 3>();
    case edge_edge: return ask.template operator()<edge_edge, 3>();
    case vertex_edge:
      if (dimension == 2) return ask.template operator()<vertex_edge, 2>();
      return ask.template operator()<vertex_edge, 3>();
    case vertex_vertex: break;
  }
  if (dimension == 2) return ask.template operator()<vertex_vertex, 2>();
  return ask.template operator()<vertex_vertex, 3>();
}

/// The kernel's query for a pair of features, which move until `end` of the step: 1, or 0 if they rest.
template <FeaturePair Pair, int Dim>
Query<Pair, Dim> query_of(const FeatureQuestion<Dim>& question, int end) {
  Query<Pair, Dim> query;
  for (std::size_t i = 0; i < query.size; ++i) {
    const bool in_first = i < first_size(Pair);
    const MovingCell<Dim>& cell = in_first ? *question.first_cell : *question.second_cell;
    const int corner = in_first ? question.first.corners[i] : question.second.corners[i - first_size(Pair)];
    query.x_t0[i] = cell.position(0, corner);
    query.x_t1[i] = cell.position(end, corner);
  }
  return query;
}

/// The kernel's answer for a pair of features; `end` as above.
template <int Dim>
std::optional<TimeEnclosure> ask(const FeatureQuestion<Dim>& question, StageCounters& stages, int end = 1) {
  using enum FeaturePair;
  if constexpr (Dim == 3) {
    if (question.pair == vertex_face) return contact(query_of<vertex_face>(question, end), &stages);
    if (question.pair == edge_edge) return contact(query_of<edge_edge>(question, end), &stages);
  }
  if (question.pair == vertex_edge) return contact(query_of<vertex_edge>(question, end), &stages);
  return contact(query_of<vertex_vertex>(question, end), &stages);
}

/// Whether two features meet where their cells are at the beginning. No stage is counted for it.
template <int Dim>
bool meet_at_begin(const FeatureQuestion<Dim>& question) {
  StageCounters none;
  return ask(question, none, 0).has_value();
}

}  // namespace noli
