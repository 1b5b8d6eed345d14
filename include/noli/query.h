// SPDX-License-Identifier: Apache-2.0
//
// A query: two features of at most four points, each point moving linearly over one step.
//
// Notation, used throughout the kernel
//   t in [0, 1]       time within the step; x(t) = (1 - t) x_t0 + t x_t1 for every point
//   vertex_face       points v | f0 f1 f2
//   edge_edge         points a0 a1 | b0 b1
//   vertex_edge       points v | e0 e1
//   vertex_vertex     points v | w
//
// Features are closed. A degenerate feature is the convex hull of its points (a face may be a segment or a point).
// Coordinates are finite doubles and are taken as they are: nothing here rounds, welds or snaps. Their unit of
// length is the caller's.
//
//   noli::VertexFace3 query;
//   query.x_t0 = {{{0.2, 0.2, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};   // v, f0, f1, f2 at t = 0
//   query.x_t1 = {{{0.2, 0.2, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};  // at t = 1
//
// noli/contact.h and noli/time_of_impact.h decide a query. Plain values: several threads may read one.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace noli {

/// A point with Dim Cartesian coordinates, in whatever unit of length the caller uses.
template <int Dim>
using Point = std::array<double, Dim>;

using Point2 = Point<2>;
using Point3 = Point<3>;

/// Which two features a query is about.
enum class FeaturePair { vertex_face, edge_edge, vertex_edge, vertex_vertex };

constexpr std::array<FeaturePair, 4> all_feature_pairs = {FeaturePair::vertex_face, FeaturePair::edge_edge,
                                                          FeaturePair::vertex_edge, FeaturePair::vertex_vertex};

/// Number of points in the first of the two features.
constexpr std::size_t first_size(FeaturePair pair) { return pair == FeaturePair::edge_edge ? 2 : 1; }

/// Number of points in the second of the two features.
constexpr std::size_t second_size(FeaturePair pair) {
  switch (pair) {
    case FeaturePair::vertex_face: return 3;
    case FeaturePair::edge_edge:
    case FeaturePair::vertex_edge: return 2;
    case FeaturePair::vertex_vertex: return 1;
  }
  return 0;
}

constexpr std::size_t point_count(FeaturePair pair) { return first_size(pair) + second_size(pair); }

/// The name used in files, JSON and on the command line's output: "vertex_face", ...
constexpr std::string_view name(FeaturePair pair) {
  switch (pair) {
    case FeaturePair::vertex_face: return "vertex_face";
    case FeaturePair::edge_edge: return "edge_edge";
    case FeaturePair::vertex_edge: return "vertex_edge";
    case FeaturePair::vertex_vertex: return "vertex_vertex";
  }
  return "";
}

/// Two features over a step: the points of the first, then of the second, at t = 0 and at t = 1.
/// Precondition of every predicate: all coordinates are finite.
template <FeaturePair Pair, int Dim>
struct Query {
  static_assert(Dim == 2 || Dim == 3);
  static constexpr FeaturePair pair = Pair;
  static constexpr int dimension = Dim;
  static constexpr std::size_t size = point_count(Pair);

  std::array<Point<Dim>, size> x_t0;
  std::array<Point<Dim>, size> x_t1;
};

using VertexFace3 = Query<FeaturePair::vertex_face, 3>;
using EdgeEdge3 = Query<FeaturePair::edge_edge, 3>;
using VertexEdge3 = Query<FeaturePair::vertex_edge, 3>;
using VertexVertex3 = Query<FeaturePair::vertex_vertex, 3>;
using VertexEdge2 = Query<FeaturePair::vertex_edge, 2>;
using VertexVertex2 = Query<FeaturePair::vertex_vertex, 2>;

}  // namespace noli
