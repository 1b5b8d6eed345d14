// SPDX-License-Identifier: Apache-2.0
//
// Settles the usual pairs of cells at which the hierarchy ends, in few operations. Most of these cells share a corner
// or an edge, and simple directions separate most of the others.
//
// Notation
//   a         the origin: d, q(x) and the error bound are those of proofs/prover/cells/direction.h with r = a, so q(a)
//             = 0
//   abc, ade  two faces around a corner: if b, c are above a along n, and d, e below, n separates (bc, ade) and (abc,
//             de). Two directions are tried. The first goes from the middle of de to that of bc; in a grid of right
//             triangles it fails for four of the nine pairs around a vertex. The second is the difference of unit
//             vectors along the closest two edges, say ac and ad. If both faces lie in a plane, side by side within
//             half a turn, it separates them: b is closer in angle to c than to d, and e closer to d than to c.
//   abc, abd  two faces around an edge. Of the four pairs of parts, n across the edge separates (c, abd) and (abc, d)
//             if c is above and d below both a and b along n; one direction each is tried for (bc, ad) and (ac, bd):
//             n + h (b - a) and n - h (b - a). An obtuse angle at a or b, or a triangle that leans along the edge,
//             limits h: four differences of corners must stay positive along the direction at mid-time. So h is 1 or,
//             if that fails, half of the least limit.
//   abc, def  two cells without a common vertex
//
// proofs/prover/cell_pair.h settles the rest.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include "kernel/formula.h"
#include "proofs/prover/cells/direction.h"

namespace noli {

/// Points relative to a: d[point][axis].
template <int Dim, std::size_t Count>
struct PointsAround {
  std::array<std::array<BothEnds, Dim>, Count> d;
  double reach;
};

namespace detail {

template <std::size_t Dim>
std::array<BothEnds, Dim> relative(const std::array<BothEnds, Dim>& x, const std::array<BothEnds, Dim>& r) {
  if constexpr (Dim == 3) {
    return {x[0] - r[0], x[1] - r[1], x[2] - r[2]};
  } else {
    return {x[0] - r[0], x[1] - r[1]};
  }
}

template <std::size_t Dim>
BothEnds greatest_of(const std::array<BothEnds, Dim>& d) {
  const BothEnds most = max(abs(d[0]), abs(d[1]));
  if constexpr (Dim == 3) return max(most, abs(d[2]));
  return most;
}

template <std::size_t Dim, std::size_t Count>
double reach_of(const std::array<std::array<BothEnds, Dim>, Count>& d) {
  BothEnds most = greatest_of(d[0]);
  for (std::size_t i = 1; i < Count; ++i) most = max(most, greatest_of(d[i]));
  return max(most, most.swapped()).at_t0();
}

/// Twice the value at mid-time.
inline double twice_middle(BothEnds x) { return x.at_t0() + x.at_t1(); }

}  // namespace detail

/// Corners by number: `origin` is that of a in the first cell; `of_first` and `of_second` are the other points.
template <int Dim, std::size_t First, std::size_t Second, class Cell>
PointsAround<Dim, First + Second> points_around(const Cell& first, const Cell& second, std::size_t origin,
                                                const std::array<std::size_t, First>& of_first,
                                                const std::array<std::size_t, Second>& of_second) {
  PointsAround<Dim, First + Second> around;
  const std::array<BothEnds, Dim>& r = first.x(origin);
  for (std::size_t i = 0; i < First; ++i) around.d[i] = detail::relative(first.x(of_first[i]), r);
  for (std::size_t i = 0; i < Second; ++i) around.d[First + i] = detail::relative(second.x(of_second[i]), r);
  around.reach = widened(detail::reach_of(around.d), first, second);
  return around;
}

/// Projections of the points at both ends, and a bound of their errors.
template <std::size_t Count>
struct ProjectionsAround {
  std::array<BothEnds, Count> q;
  BothEnds bound;

  /// Whether point i is certainly above point j.
  bool above(std::size_t i, std::size_t j) const { return below(bound, q[i] - q[j]); }
  bool above_origin(std::size_t i) const { return below(bound, q[i]); }
  bool below_origin(std::size_t i) const { return below(bound, BothEnds(0) - q[i]); }
};

template <int Dim, std::size_t Count>
ProjectionsAround<Count> project(const PointsAround<Dim, Count>& around, const Direction<Dim>& n) {
  ProjectionsAround<Count> p;
  for (std::size_t i = 0; i < Count; ++i) {
    const std::array<BothEnds, Dim>& d = around.d[i];
    p.q[i] = BothEnds(n[0]) * d[0] + BothEnds(n[1]) * d[1];
    if constexpr (Dim == 3) p.q[i] = p.q[i] + BothEnds(n[2]) * d[2];
  }
  p.bound = BothEnds(error_bound<Dim>(n, around.reach));
  return p;
}

/// Leaves a direction unrounded before it is tested.
constexpr auto as_it_is = [](const auto& n) { return n; };

/// Points b, c, d, e: four times the vector from the middle of de to that of bc at mid-time.
template <int Dim>
std::array<double, Dim> between_middles(const PointsAround<Dim, 4>& points) {
  const auto& [b, c, d, e] = points.d;
  std::array<double, Dim> n;
  for (std::size_t k = 0; k < Dim; ++k) n[k] = detail::twice_middle((b[k] + c[k]) - (d[k] + e[k]));
  return n;
}

/// Points b, c, d, e: the difference of two unit vectors at mid-time, towards b or c and towards d or e, whichever two
/// are at the smallest angle. It may be 0, infinite or NaN if a length is 0, overflows or underflows, and then no test
/// passes.
template <int Dim>
std::array<double, Dim> between_closest_edges(const PointsAround<Dim, 4>& points) {
  std::array<std::array<double, Dim>, 4> u;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < Dim; ++k) u[i][k] = detail::twice_middle(points.d[i][k]);
    const double length = std::sqrt(formula::dot(u[i], u[i]));
    for (double& part : u[i]) part /= length;
  }
  std::size_t first = 0, second = 2;
  double greatest = formula::dot(u[0], u[2]);
  for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 3}, {1, 2}, {1, 3}}) {
    const double cosine = formula::dot(u[i], u[j]);
    if (!(cosine > greatest)) continue;
    greatest = cosine, first = i, second = j;
  }
  std::array<double, Dim> n;
  for (std::size_t k = 0; k < Dim; ++k) n[k] = u[first][k] - u[second][k];
  return n;
}

/// Points b, c, d, e: whether a direction certainly separates (bc, ade) and (abc, de).
template <int Dim>
bool separates_corner(const PointsAround<Dim, 4>& points, const Direction<Dim>& n) {
  const auto p = project(points, n);
  return p.above_origin(0) && p.above_origin(1) && p.below_origin(2) && p.below_origin(3);
}

/// Points b, c, d, e: a direction that separates (bc, ade) and (abc, de).
template <int Dim, class Round = decltype(as_it_is)>
std::optional<std::array<double, Dim>> around_corner(const PointsAround<Dim, 4>& points, const Round& round = {}) {
  std::array<double, Dim> n = round(between_middles(points));
  if (separates_corner(points, n)) return n;
  n = round(between_closest_edges(points));
  if (separates_corner(points, n)) return n;
  return std::nullopt;
}

/// Points b, c, d, e, f: +1 if n, -1 if -n certainly separates abc (above) from def; 0 if neither is certain.
template <int Dim>
int separates(const PointsAround<Dim, 5>& points, const Direction<Dim>& n) {
  const auto p = project(points, n);
  const BothEnds origin(0);
  const BothEnds least_abc = min(origin, min(p.q[0], p.q[1])), most_abc = max(origin, max(p.q[0], p.q[1]));
  const BothEnds least_def = min(p.q[2], min(p.q[3], p.q[4])), most_def = max(p.q[2], max(p.q[3], p.q[4]));
  if (below(p.bound, least_abc - most_def)) return 1;
  return below(p.bound, least_def - most_abc) ? -1 : 0;
}

/// Points b, c, d, e, f: six times the vector from the middle of def to that of abc at mid-time.
template <int Dim>
std::array<double, Dim> between_middles(const PointsAround<Dim, 5>& points) {
  const auto& [b, c, d, e, f] = points.d;
  std::array<double, Dim> n;
  for (std::size_t k = 0; k < Dim; ++k) n[k] = detail::twice_middle((b[k] + c[k]) - (d[k] + e[k] + f[k]));
  return n;
}

/// Four times a normal of the triangle on three points at mid-time, rounded.
inline std::array<double, 3> mid_normal(const std::array<BothEnds, 3>& p, const std::array<BothEnds, 3>& q,
                                        const std::array<BothEnds, 3>& r) {
  std::array<double, 3> u, v;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = detail::twice_middle(q[k] - p[k]);
    v[k] = detail::twice_middle(r[k] - p[k]);
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

namespace detail {

/// A difference of corners, along n and along the edge: height + h along has to be positive.
struct AboveAlongEdge {
  double height, along;
};

/// How much of the edge to add to n: 1, or half of the least limit.
inline double share_of_edge(const std::array<AboveAlongEdge, 3>& conditions) {
  double h = 1;
  for (const auto& [height, along] : conditions) {
    if (along < 0 && height < -2 * along * h) h = height / (-2 * along);
  }
  return h;
}

}  // namespace detail

/// The directions found around an edge, in the order (c, abd), (bc, ad), (ac, bd), (abc, d).
template <int Dim>
struct AroundEdge {
  std::array<std::array<double, Dim>, 4> n;
  std::array<bool, 4> found{};
};

/// Directions that separate the four pairs of parts. Points b, c, d, and possibly d again.
template <int Dim, std::size_t Count, class Round = decltype(as_it_is)>
AroundEdge<Dim> around_edge(const PointsAround<Dim, Count>& points, const Round& round = {}) {
  constexpr std::size_t b = 0, c = 1, d = 2;
  std::array<double, Dim> edge, to_c, to_d, n;
  for (std::size_t k = 0; k < Dim; ++k) {
    edge[k] = detail::twice_middle(points.d[b][k]);
    to_c[k] = detail::twice_middle(points.d[c][k]);
    to_d[k] = detail::twice_middle(points.d[d][k]);
  }
  const double e_b = formula::dot(edge, edge), e_c = formula::dot(edge, to_c), e_d = formula::dot(edge, to_d);
  for (std::size_t k = 0; k < Dim; ++k) n[k] = to_c[k] - to_d[k] - (e_c - e_d) / e_b * edge[k];
  AroundEdge<Dim> result;
  result.n[0] = result.n[3] = round(n);
  const auto p = project(points, result.n[0]);
  result.found[0] = p.above_origin(c) && p.above(c, b) && p.above(c, d);
  result.found[3] = p.below_origin(d) && p.above(b, d) && p.above(c, d);
  const auto try_bc = [&](double h) {
    for (std::size_t k = 0; k < Dim; ++k) result.n[1][k] = n[k] + h * edge[k];
    result.n[1] = round(result.n[1]);
    const auto q = project(points, result.n[1]);
    result.found[1] = q.above_origin(b) && q.above_origin(c) && q.above(b, d) && q.above(c, d);
  };
  const auto try_ac = [&](double h) {
    for (std::size_t k = 0; k < Dim; ++k) result.n[2][k] = n[k] - h * edge[k];
    result.n[2] = round(result.n[2]);
    const auto r = project(points, result.n[2]);
    result.found[2] = r.below_origin(b) && r.below_origin(d) && r.above(c, b) && r.above(c, d);
  };
  try_bc(1);
  try_ac(1);
  if (result.found[1] && result.found[2]) return result;
  const double n_c = formula::dot(n, to_c), n_d = formula::dot(n, to_d);
  if (!result.found[1]) try_bc(detail::share_of_edge({{{n_c, e_c}, {-n_d, e_b - e_d}, {n_c - n_d, e_c - e_d}}}));
  if (!result.found[2]) try_ac(detail::share_of_edge({{{n_c, e_b - e_c}, {-n_d, e_d}, {n_c - n_d, e_d - e_c}}}));
  return result;
}

}  // namespace noli
