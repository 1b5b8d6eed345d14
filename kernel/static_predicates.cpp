// SPDX-License-Identifier: Apache-2.0
//
// Reduces every predicate to orientations and comparisons.
//
// Notation: a view drops one coordinate. If coplanar simplices do not lose a dimension in a view, it is one-to-one on
// their plane, and the question becomes planar.
#include "kernel/static_predicates.h"

#include <algorithm>
#include <optional>

namespace noli {
namespace {

template <int Dim, std::size_t N, std::size_t M>
bool boxes_apart(const std::array<Point<Dim>, N>& a, const std::array<Point<Dim>, M>& b) {
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    double a_low = a[0][axis], a_high = a_low, b_low = b[0][axis], b_high = b_low;
    for (const auto& p : a) {
      a_low = std::min(a_low, p[axis]);
      a_high = std::max(a_high, p[axis]);
    }
    for (const auto& p : b) {
      b_low = std::min(b_low, p[axis]);
      b_high = std::max(b_high, p[axis]);
    }
    if (a_high < b_low || b_high < a_low) return true;
  }
  return false;
}

Point2 seen(const Point3& p, std::size_t axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

template <std::size_t N>
std::array<Point2, N> seen(const std::array<Point3, N>& x, std::size_t axis) {
  std::array<Point2, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = seen(x[i], axis);
  return result;
}

template <int Dim>
std::array<Segment<Dim>, 3> edges(const Triangle<Dim>& t) {
  return {{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}};
}

template <class Simplex, int Dim>
bool meets_an_edge(const Simplex& s, const Triangle<Dim>& t) {
  return std::ranges::any_of(edges<Dim>(t), [&s](const Segment<Dim>& edge) { return intersects(s, edge); });
}

/// A view in which the triangle keeps its area, if it has any.
std::optional<std::size_t> view_of(const Triangle3& t) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Triangle2 flat = seen(t, axis);
    if (orientation(flat[0], flat[1], flat[2]) != 0) return axis;
  }
  return std::nullopt;
}

/// A view in which the four coplanar ends of two segments are not on a line, unless they are on one in space.
std::optional<std::size_t> view_of(const Segment3& s, const Segment3& r) {
  for (const Triangle3& three : {Triangle3{s[0], s[1], r[0]}, Triangle3{s[0], s[1], r[1]}, Triangle3{r[0], r[1], s[0]},
                                 Triangle3{r[0], r[1], s[1]}}) {
    if (const auto axis = view_of(three)) return axis;
  }
  return std::nullopt;
}

bool same_strict_side(int a, int b) { return a * b > 0; }

/// Whether signs of both kinds occur.
bool disagree(int a, int b, int c) { return std::max({a, b, c}) > 0 && std::min({a, b, c}) < 0; }

/// The sides of the plane of t on which the points are.
template <std::size_t N>
std::array<int, N> sides(const Triangle3& t, const std::array<Point3, N>& points) {
  std::array<int, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = orientation(t[0], t[1], t[2], points[i]);
  return result;
}

bool one_strict_side(const std::array<int, 3>& side) {
  return same_strict_side(side[0], side[1]) && same_strict_side(side[1], side[2]);
}

/// Precondition: the ends of the segment are not both in the plane of the triangle, nor strictly on one side of it. The
/// line of the segment then meets the plane in one point, which has to be in the triangle.
bool pierces(const Segment3& s, const Triangle3& t) {
  const int a = orientation(s[0], s[1], t[0], t[1]), b = orientation(s[0], s[1], t[1], t[2]);
  if (same_strict_side(a, -b)) return false;
  return !disagree(a, b, orientation(s[0], s[1], t[2], t[0]));
}

/// Precondition: the ends of the segment are in the plane of the triangle, or the triangle has no plane.
bool intersects_flat(const Segment3& s, const Triangle3& t) {
  const auto axis = view_of(t);
  return axis ? intersects(seen(s, *axis), seen(t, *axis)) : meets_an_edge<Segment3, 3>(s, t);
}

bool intersects_given_sides(const Segment3& s, int side0, int side1, const Triangle3& t) {
  if (same_strict_side(side0, side1)) return false;
  return side0 == 0 && side1 == 0 ? intersects_flat(s, t) : pierces(s, t);
}

/// Whether an edge of s meets t; side: of the plane of t, for each corner of s.
bool an_edge_meets(const Triangle3& s, const std::array<int, 3>& side, const Triangle3& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (intersects_given_sides({s[i], s[j]}, side[i], side[j], t)) return true;
  }
  return false;
}

}  // namespace

bool intersects(const Point2& p, const Segment2& s) {
  return !boxes_apart<2>(std::array<Point2, 1>{p}, s) && orientation(s[0], s[1], p) == 0;
}

bool intersects(const Point3& p, const Segment3& s) {
  if (boxes_apart<3>(std::array<Point3, 1>{p}, s)) return false;
  return !view_of(Triangle3{s[0], s[1], p});
}

bool intersects(const Point2& p, const Triangle2& t) {
  if (boxes_apart<2>(std::array<Point2, 1>{p}, t)) return false;
  if (orientation(t[0], t[1], t[2]) == 0) return meets_an_edge<Point2, 2>(p, t);
  return !disagree(orientation(t[0], t[1], p), orientation(t[1], t[2], p), orientation(t[2], t[0], p));
}

bool intersects(const Point3& p, const Triangle3& t) {
  if (boxes_apart<3>(std::array<Point3, 1>{p}, t) || orientation(t[0], t[1], t[2], p) != 0) return false;
  const auto axis = view_of(t);
  return axis ? intersects(seen(p, *axis), seen(t, *axis)) : meets_an_edge<Point3, 3>(p, t);
}

bool intersects(const Segment2& s, const Segment2& r) {
  if (boxes_apart<2>(s, r)) return false;  // also decides when all ends are on one line: then all orientations are zero
  return !same_strict_side(orientation(s[0], s[1], r[0]), orientation(s[0], s[1], r[1])) &&
         !same_strict_side(orientation(r[0], r[1], s[0]), orientation(r[0], r[1], s[1]));
}

bool intersects(const Segment3& s, const Segment3& r) {
  if (boxes_apart<3>(s, r) || orientation(s[0], s[1], r[0], r[1]) != 0) return false;
  const auto axis = view_of(s, r);
  return !axis || intersects(seen(s, *axis), seen(r, *axis));  // on one line: the boxes have decided
}

bool intersects(const Segment2& s, const Triangle2& t) {
  if (boxes_apart<2>(s, t)) return false;
  return intersects(s[0], t) || meets_an_edge<Segment2, 2>(s, t);
}

bool intersects(const Segment3& s, const Triangle3& t) {
  if (boxes_apart<3>(s, t)) return false;
  const auto side = sides(t, s);
  return intersects_given_sides(s, side[0], side[1], t);
}

bool intersects(const Triangle2& s, const Triangle2& t) {
  if (boxes_apart<2>(s, t)) return false;
  return std::ranges::any_of(edges<2>(s), [&t](const Segment2& edge) { return intersects(edge, t); }) ||
         intersects(t[0], s);  // t inside s
}

/// If they meet, an edge of one meets the other: the intersection is convex, and its extreme points are on an edge of
/// one of them.
bool intersects(const Triangle3& s, const Triangle3& t) {
  if (boxes_apart<3>(s, t)) return false;
  const auto side_s = sides(t, s);
  if (one_strict_side(side_s)) return false;
  const auto side_t = sides(s, t);
  if (one_strict_side(side_t)) return false;
  return an_edge_meets(s, side_s, t) || an_edge_meets(t, side_t, s);
}

}  // namespace noli
