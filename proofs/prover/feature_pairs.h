// SPDX-License-Identifier: Apache-2.0
//
// The pairs of features of two cells, as sets, and the exact question about one of them.
//
// Notation
//   a, b       two different cells; a_i, b_j their corners; e_i the edge of a face from corner i to corner i + 1
//   PairSet    bits, in 3D: i (0 to 2) a_i against the face b; 3 + j: b_j against the face a; 8 + 3 i + j: edge i of a
//              against edge j of b;
//              in 2D: 3 i + j: a_i against edge j of b; 9 + 3 j + i: b_j against edge i of a.
//              In both: 20 the loose point a against the loose edge b (3D), 21 the reverse (3D), 22 two loose points
//
// Which pairs of features there are is said in proofs/prover/verifier.h.
//
// What this does not do: it does not know which features share vertices; the parts it is given do not
// (proofs/prover/cell_pair.h).
#pragma once

#include <bit>
#include <cstdint>

#include "noli/kernel/contact.h"
#include "noli/proofs/prover/direction.h"
#include "noli/proofs/prover/moving_cell.h"

namespace noli {

using PairSet = std::uint32_t;

namespace detail {

constexpr PairSet point_edge_bit = PairSet{1} << 20;
constexpr PairSet edge_point_bit = PairSet{1} << 21;
constexpr PairSet point_point_bit = PairSet{1} << 22;

/// The edges whose two ends are in a part: bit i for edge i.
constexpr unsigned edges_in(CornerMask part) {
  constexpr std::array<std::uint8_t, 8> table = {0, 0, 0, 1, 0, 4, 2, 7};
  return table[part];
}

/// Bit 3 i + j for each i in rows and j in columns.
constexpr PairSet product(unsigned rows, unsigned columns) {
  return ((rows & 1) != 0 ? columns : 0) | ((rows & 2) != 0 ? columns << 3 : 0) | ((rows & 4) != 0 ? columns << 6 : 0);
}

constexpr PairSet loose_pair(int dimension, int a_corners, int b_corners) {
  if (a_corners == 1 && b_corners == 1) return point_point_bit;
  if (dimension == 2) return 0;
  if (a_corners == 1 && b_corners == 2) return point_edge_bit;
  return a_corners == 2 && b_corners == 1 ? edge_point_bit : 0;
}

/// The pairs of the given corners and edges of a with those of b, and of the two cells as wholes if asked for. A face
/// counts as present if `a_face`, `b_face`.
template <int Dim>
PairSet pair_set(unsigned a_corners, unsigned a_edges, bool a_face, unsigned b_corners, unsigned b_edges, bool b_face) {
  if constexpr (Dim == 3) {
    return (b_face ? a_corners : 0) | (a_face ? b_corners << 3 : 0) | product(a_edges, b_edges) << 8;
  } else {
    return product(a_corners, b_edges) | product(b_corners, a_edges) << 9;
  }
}

}  // namespace detail

/// All pairs of a feature on the corners a_part of a with a feature on the corners b_part of b.
template <int Dim>
PairSet pairs_within(const CellNames& a, CornerMask a_part, const CellNames& b, CornerMask b_part) {
  const bool a_whole = a_part == all_corners(a.corners), b_whole = b_part == all_corners(b.corners);
  const PairSet pairs = detail::pair_set<Dim>(a_part, detail::edges_in(a_part), a_whole && a.corners == 3, b_part,
                                              detail::edges_in(b_part), b_whole && b.corners == 3);
  return a_whole && b_whole ? pairs | detail::loose_pair(Dim, a.corners, b.corners) : pairs;
}

template <int Dim>
PairSet pairs_within(const MovingCell<Dim>& a, CornerMask a_part, const MovingCell<Dim>& b, CornerMask b_part) {
  return pairs_within<Dim>(static_cast<const CellNames&>(a), a_part, static_cast<const CellNames&>(b), b_part);
}

/// The pairs of features that belong to this pair of cells.
template <int Dim>
PairSet pairs_owned(const CellNames& a, const CellNames& b) {
  const PairSet pairs = detail::pair_set<Dim>(a.owned & 7, a.owned >> 3 & 7, a.corners == 3, b.owned & 7,
                                              b.owned >> 3 & 7, b.corners == 3);
  const bool listed = (a.owned & b.owned & cell_bit) != 0;
  return listed ? pairs | detail::loose_pair(Dim, a.corners, b.corners) : pairs;
}

template <int Dim>
PairSet pairs_owned(const MovingCell<Dim>& a, const MovingCell<Dim>& b) {
  return pairs_owned<Dim>(static_cast<const CellNames&>(a), static_cast<const CellNames&>(b));
}

/// One feature of a cell, by its corners; `size` of them count.
struct Feature {
  std::array<std::uint8_t, 3> corners{};
  std::uint8_t size = 0;
};

constexpr Feature corner_feature(unsigned i) { return {{static_cast<std::uint8_t>(i)}, 1}; }
constexpr Feature edge_feature(unsigned i) {
  return {{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i == 2 ? 0 : i + 1)}, 2};
}
constexpr Feature face_feature = {{0, 1, 2}, 3};

/// A pair of features, in the order of kernel/query.h.
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

/// The pair of features that the lowest bit of a set stands for. Precondition: the set is not empty.
template <int Dim>
FeatureQuestion<Dim> first_of(PairSet set, const MovingCell<Dim>& a, const MovingCell<Dim>& b) {
  using Question = FeatureQuestion<Dim>;
  const auto bit = static_cast<unsigned>(std::countr_zero(set));
  if (bit == 22) return Question{FeaturePair::vertex_vertex, &a, corner_feature(0), &b, corner_feature(0)};
  if (bit == 21) return Question{FeaturePair::vertex_edge, &b, corner_feature(0), &a, edge_feature(0)};
  if (bit == 20) return Question{FeaturePair::vertex_edge, &a, corner_feature(0), &b, edge_feature(0)};
  if constexpr (Dim == 3) {
    if (bit < 3) return Question{FeaturePair::vertex_face, &a, corner_feature(bit), &b, face_feature};
    if (bit < 6) return Question{FeaturePair::vertex_face, &b, corner_feature(bit - 3), &a, face_feature};
    return Question{FeaturePair::edge_edge, &a, edge_feature((bit - 8) / 3), &b, edge_feature((bit - 8) % 3)};
  } else {
    if (bit < 9) return Question{FeaturePair::vertex_edge, &a, corner_feature(bit / 3), &b, edge_feature(bit % 3)};
    return Question{FeaturePair::vertex_edge, &b, corner_feature((bit - 9) / 3), &a, edge_feature((bit - 9) % 3)};
  }
}

/// The kernel's query for a pair of features.
template <FeaturePair Pair, int Dim>
Query<Pair, Dim> query_of(const FeatureQuestion<Dim>& question) {
  Query<Pair, Dim> query;
  for (std::size_t i = 0; i < query.size; ++i) {
    const bool in_first = i < first_size(Pair);
    const MovingCell<Dim>& cell = in_first ? *question.first_cell : *question.second_cell;
    const int corner = in_first ? question.first.corners[i] : question.second.corners[i - first_size(Pair)];
    query.x_t0[i] = cell.position(0, corner);
    query.x_t1[i] = cell.position(1, corner);
  }
  return query;
}

/// The kernel's answer for a pair of features.
template <int Dim>
std::optional<TimeEnclosure> ask(const FeatureQuestion<Dim>& question, StageCounters& stages) {
  if constexpr (Dim == 3) {
    if (question.pair == FeaturePair::vertex_face)
      return contact(query_of<FeaturePair::vertex_face>(question), &stages);
    if (question.pair == FeaturePair::edge_edge) return contact(query_of<FeaturePair::edge_edge>(question), &stages);
  }
  if (question.pair == FeaturePair::vertex_edge) return contact(query_of<FeaturePair::vertex_edge>(question), &stages);
  return contact(query_of<FeaturePair::vertex_vertex>(question), &stages);
}

}  // namespace noli
