// SPDX-License-Identifier: Apache-2.0
//
// A query whose pair of features and dimension are known only at run time, as from files and generators. `visit` passes
// it to code that is typed by them.
#pragma once

#include <array>
#include <cstddef>

#include <noli/query.h>
#include "trajectory/formats/query_csv.h"

namespace noli {

/// Two features over a step. Only the first point_count(pair) points and the first `dimension` coordinates count; the
/// rest are zero. In 3D every pair exists, in 2D vertex_edge and vertex_vertex.
struct AnyQuery {
  FeaturePair pair = FeaturePair::vertex_face;
  int dimension = 3;
  std::array<Point3, 4> x_t0{};
  std::array<Point3, 4> x_t1{};

  std::size_t size() const { return point_count(pair); }
  friend bool operator==(const AnyQuery&, const AnyQuery&) = default;
};

/// The six combinations of a pair of features and a dimension.
struct QueryType {
  FeaturePair pair;
  int dimension;
  friend bool operator==(const QueryType&, const QueryType&) = default;
};

constexpr std::array<QueryType, 6> all_query_types = {{{FeaturePair::vertex_face, 3},
                                                       {FeaturePair::edge_edge, 3},
                                                       {FeaturePair::vertex_edge, 3},
                                                       {FeaturePair::vertex_vertex, 3},
                                                       {FeaturePair::vertex_edge, 2},
                                                       {FeaturePair::vertex_vertex, 2}}};

/// The kind of a pair in trajectory/formats/query_csv.h.
constexpr QueryKind file_kind(FeaturePair pair) {
  switch (pair) {
    case FeaturePair::vertex_face: return QueryKind::vertex_face;
    case FeaturePair::edge_edge: return QueryKind::edge_edge;
    case FeaturePair::vertex_edge: return QueryKind::vertex_edge;
    case FeaturePair::vertex_vertex: return QueryKind::vertex_vertex;
  }
  return QueryKind::vertex_face;
}

namespace detail {
template <FeaturePair Pair, int Dim>
Query<Pair, Dim> typed(const AnyQuery& query) {
  Query<Pair, Dim> result;
  for (std::size_t i = 0; i < result.size; ++i) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      result.x_t0[i][axis] = query.x_t0[i][axis];
      result.x_t1[i][axis] = query.x_t1[i][axis];
    }
  }
  return result;
}
}  // namespace detail

/// Calls `function` with the query as a Query<Pair, Dim>. Precondition: the combination is one of all_query_types.
template <class Function>
auto visit(const AnyQuery& query, Function&& function) {
  const bool planar = query.dimension == 2;
  switch (query.pair) {
    case FeaturePair::vertex_face: return function(detail::typed<FeaturePair::vertex_face, 3>(query));
    case FeaturePair::edge_edge: return function(detail::typed<FeaturePair::edge_edge, 3>(query));
    case FeaturePair::vertex_edge:
      return planar ? function(detail::typed<FeaturePair::vertex_edge, 2>(query))
                    : function(detail::typed<FeaturePair::vertex_edge, 3>(query));
    case FeaturePair::vertex_vertex: break;
  }
  return planar ? function(detail::typed<FeaturePair::vertex_vertex, 2>(query))
                : function(detail::typed<FeaturePair::vertex_vertex, 3>(query));
}

}  // namespace noli
