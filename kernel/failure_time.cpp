// SPDX-License-Identifier: Apache-2.0
//
// Notation: a line, seen along n, is (offset + slope t) / scale with scale > 0. The certificate fails where the line of
// n . (a - b) - g is not positive.
//
// Stages: intervals say that it has failed or that it never will; the quotient needs an exact ring, as it is rounded
// exactly.
#include "kernel/failure_time.h"

#include <CGAL/Gmpzf.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>

#include "kernel/arithmetic/rounding.h"

namespace noli {
namespace {

#ifdef CGAL_HAS_MPZF
using Exact = CGAL::Mpzf;  // without allocation for moderate exponents
#else
using Exact = CGAL::Gmpzf;
#endif
using Interval = CGAL::Interval_nt<false>;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
struct Line {
  T offset, slope, scale;
};

template <class T, std::size_t Dim>
T dot(const Point<Dim>& n, const Point<Dim>& x) {
  T sum = T(n[0]) * T(x[0]);
  for (std::size_t i = 1; i < Dim; ++i) sum = sum + T(n[i]) * T(x[i]);
  return sum;
}

template <class T, int Dim>
Line<T> seen_along(const Point<Dim>& n, const Ray<Dim>& p) {
  const T speed = dot<T, Dim>(n, p.v);
  return {dot<T, Dim>(n, p.x) - T(p.t) * speed, speed, T(1)};
}

template <class T, int Dim>
Line<T> seen_along(const Point<Dim>& n, const MotionSegment<Dim>& p) {
  const T at_t0 = dot<T, Dim>(n, p.x0), at_t1 = dot<T, Dim>(n, p.x1);
  return {at_t0 * T(p.t1) - at_t1 * T(p.t0), at_t1 - at_t0, T(p.t1) - T(p.t0)};
}

/// n . (a - b) - g, times a positive constant.
template <class T, int Dim, class A, class B>
Line<T> margin(const A& a, const B& b, const Point<Dim>& n, double g) {
  const Line<T> p = seen_along<T, Dim>(n, a), q = seen_along<T, Dim>(n, b);
  return {p.offset * q.scale - q.offset * p.scale - T(g) * p.scale * q.scale, p.slope * q.scale - q.slope * p.scale,
          p.scale * q.scale};
}

template <class T>
T value_at(const Line<T>& line, double t) {
  return line.offset + line.slope * T(t);
}

/// `from` or infinity when intervals can tell.
template <int Dim, class A, class B>
std::optional<double> filtered(const A& a, const B& b, const Point<Dim>& n, double g, double from) {
  const Interval::Protector upward;
  const Line<Interval> line = margin<Interval, Dim>(a, b, n, g);
  const Interval now = value_at(line, from);
  if (now.sup() <= 0) return from;
  if (now.inf() > 0 && line.slope.inf() >= 0) return infinity;
  return std::nullopt;
}

int sign(const Exact& x) { return static_cast<int>(CGAL::sign(x)); }

/// Doubles in ascending order are integers in ascending order; -0 comes just before 0.
std::int64_t order_of(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits - 1;
}
double of_order(std::int64_t order) {
  return std::bit_cast<double>(order >= 0 ? order : std::numeric_limits<std::int64_t>::min() - order - 1);
}

/// The largest double that is not after the zero of a falling line, which is not before `from`.
double zero_rounded_down(const Line<Exact>& line, double from) {
  std::int64_t low = order_of(from), high = order_of(infinity);  // of_order(low) <= zero < of_order(high)
  const auto probe = [&](std::int64_t order) {
    if (order > low && order < high) (sign(value_at(line, of_order(order))) >= 0 ? low : high) = order;
  };
  // Near the zero; meaningless where doubles cannot hold it.
  const double guess = CGAL::to_double(line.offset) / CGAL::to_double(-line.slope);
  if (std::isfinite(guess)) {
    for (const std::int64_t step : {0, 1, -1, 64, -64}) probe(order_of(guess) + step);
  }
  while (low + 1 < high) probe(std::midpoint(low, high));  // their difference might overflow
  return of_order(low);
}

template <int Dim, class A, class B>
double exact_failure_time(const A& a, const B& b, const Point<Dim>& n, double g, double from) {
  const Line<Exact> line = margin<Exact, Dim>(a, b, n, g);
  if (sign(value_at(line, from)) <= 0) return from;
  return sign(line.slope) >= 0 ? infinity : zero_rounded_down(line, from);
}

}  // namespace

template <class A, class B>
double failure_time(const A& a, const B& b, const Point<A::dimension>& n, double g, double from) {
  constexpr int Dim = A::dimension;
  if (rounding_self_test().directed_ok) {
    if (const auto answer = filtered<Dim>(a, b, n, g, from)) return *answer;
  }
  return exact_failure_time<Dim>(a, b, n, g, from);
}

template double failure_time(const Ray<2>&, const Ray<2>&, const Point2&, double, double);
template double failure_time(const Ray<2>&, const MotionSegment<2>&, const Point2&, double, double);
template double failure_time(const MotionSegment<2>&, const Ray<2>&, const Point2&, double, double);
template double failure_time(const MotionSegment<2>&, const MotionSegment<2>&, const Point2&, double, double);
template double failure_time(const Ray<3>&, const Ray<3>&, const Point3&, double, double);
template double failure_time(const Ray<3>&, const MotionSegment<3>&, const Point3&, double, double);
template double failure_time(const MotionSegment<3>&, const Ray<3>&, const Point3&, double, double);
template double failure_time(const MotionSegment<3>&, const MotionSegment<3>&, const Point3&, double, double);

}  // namespace noli
