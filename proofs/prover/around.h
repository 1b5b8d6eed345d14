// SPDX-License-Identifier: Apache-2.0
//
// Cells that share a corner or an edge, as most of the pairs do in which the hierarchy ends: the usual case in few
// operations.
//
// Notation
//   a         the shared vertex that is the origin: d, q(x) and the error bound are those of proofs/prover/direction.h
//             with r = a, so q(a) = 0
//   abc, ade  two faces around a corner: if n has b, c on its upper and d, e on its lower side of a, it separates (bc,
//             ade) and (abc, de)
//   abc, abd  two faces around an edge. Of the four pairs of parts, n across the edge separates (c, abd) and (abc, d)
//             if it has c above and d below both a and b; one direction each is tried for (bc, ad) and (ac, bd)
//
// What this does not do: what it does not settle it leaves to proofs/prover/cell_pair.h.
#pragma once

#include <optional>

#include "noli/proofs/prover/direction.h"

namespace noli {

/// Four points relative to a: d[end][axis][point].
template <int Dim>
struct FourAround {
  std::array<std::array<std::array<double, 4>, Dim>, 2> d;
  double reach;
};

/// Which corner of which of the two cells (false: the first).
struct CornerOf {
  bool second;
  std::size_t corner;
};

template <int Dim>
FourAround<Dim> four_around(const MovingCell<Dim>& a, const MovingCell<Dim>& b, std::size_t origin,
                            const std::array<CornerOf, 4>& points) {
  FourAround<Dim> four;
  std::array<double, 4> most{};
  for (std::size_t e = 0; e < 2; ++e) {
    for (std::size_t k = 0; k < Dim; ++k) {
      const double r = a.x[e][k][origin];
      std::array<double, 4>& d = four.d[e][k];
      for (std::size_t i = 0; i < 4; ++i) d[i] = (points[i].second ? b : a).x[e][k][points[i].corner];
      for (std::size_t i = 0; i < 4; ++i) d[i] -= r;
      for (std::size_t i = 0; i < 4; ++i) most[i] = most[i] > std::abs(d[i]) ? most[i] : std::abs(d[i]);
    }
  }
  four.reach = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  return four;
}

/// Projections of the four points at both ends, and what they may be wrong by.
struct FourProjections {
  std::array<std::array<double, 4>, 2> q;
  double bound;

  /// Whether point i is certainly above point j.
  bool above(std::size_t i, std::size_t j) const { return q[0][i] - q[0][j] > bound && q[1][i] - q[1][j] > bound; }
  bool above_origin(std::size_t i) const { return q[0][i] > bound && q[1][i] > bound; }
  bool below_origin(std::size_t i) const { return q[0][i] < -bound && q[1][i] < -bound; }
};

template <int Dim>
FourProjections project(const FourAround<Dim>& four, const Direction<Dim>& n) {
  FourProjections p;
  for (std::size_t e = 0; e < 2; ++e) {
    for (std::size_t i = 0; i < 4; ++i) {
      double sum = n[0] * four.d[e][0][i] + n[1] * four.d[e][1][i];
      if constexpr (Dim == 3) sum += n[2] * four.d[e][2][i];
      p.q[e][i] = sum;
    }
  }
  p.bound = error_bound<Dim>(n, four.reach);
  return p;
}

/// Twice the weighted sum of the points at mid-time.
template <int Dim>
std::array<double, Dim> mid_sum(const FourAround<Dim>& four, const std::array<double, 4>& weights) {
  std::array<double, Dim> n;
  for (std::size_t k = 0; k < Dim; ++k) {
    const auto &p = four.d[0][k], &q = four.d[1][k];
    n[k] = (weights[0] * (p[0] + q[0]) + weights[1] * (p[1] + q[1])) +
           (weights[2] * (p[2] + q[2]) + weights[3] * (p[3] + q[3]));
  }
  return n;
}

/// Points b, c, d, e: a direction that separates (bc, ade) and (abc, de).
template <int Dim>
std::optional<std::array<double, Dim>> around_corner(const FourAround<Dim>& four) {
  const auto n = mid_sum(four, {1, 1, -1, -1});
  const FourProjections p = project(four, n);
  if (p.above_origin(0) && p.above_origin(1) && p.below_origin(2) && p.below_origin(3)) return n;
  return std::nullopt;
}

/// What was found around an edge, in the order (c, abd), (bc, ad), (ac, bd), (abc, d).
template <int Dim>
struct AroundEdge {
  std::array<std::array<double, Dim>, 4> n;
  std::array<bool, 4> found{};
};

/// Points b, c, d, d: directions that separate the four pairs of parts.
template <int Dim>
AroundEdge<Dim> around_edge(const FourAround<Dim>& four) {
  constexpr std::size_t b = 0, c = 1, d = 2;
  const auto edge = mid_sum(four, {1, 0, 0, 0});
  auto across = mid_sum(four, {0, 1, -1, 0});
  double along = 0, length = 0;
  for (std::size_t k = 0; k < Dim; ++k) {
    along += across[k] * edge[k];
    length += edge[k] * edge[k];
  }
  for (std::size_t k = 0; k < Dim; ++k) across[k] -= along / length * edge[k];

  AroundEdge<Dim> result;
  const FourProjections p = project(four, across);
  result.n[0] = result.n[3] = across;
  result.found[0] = p.above_origin(c) && p.above(c, b) && p.above(c, d);
  result.found[3] = p.below_origin(d) && p.above(b, d) && p.above(c, d);
  result.n[1] = mid_sum(four, {1, 1, -1, 0});  // b, c above a, d
  const FourProjections q = project(four, result.n[1]);
  result.found[1] = q.above_origin(b) && q.above_origin(c) && q.above(b, d) && q.above(c, d);
  result.n[2] = mid_sum(four, {-1, 1, -1, 0});  // a, c above b, d
  const FourProjections r = project(four, result.n[2]);
  result.found[2] = r.below_origin(b) && r.below_origin(d) && r.above(c, b) && r.above(c, d);
  return result;
}

}  // namespace noli
