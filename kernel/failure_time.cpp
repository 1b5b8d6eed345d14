// SPDX-License-Identifier: Apache-2.0
//
// Computes until when certificates hold.
//
// Notation: a line, seen along n, is (offset + slope t) / scale with scale > 0. The certificate fails where the line of
// n . (a - b) - g is not positive.
//
// Stages for two points: intervals decide that it has already failed or never will. Otherwise the quotient needs an
// exact ring, as it is rounded exactly.
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
using detail::dot;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
struct Line {
  T offset, slope, scale;
};

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

/// `from` or infinity if intervals can decide.
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

/// The last double at which `holds` is true. Precondition: it is true at `from`, and once false it stays false.
/// `guess`:
/// near that time, or meaningless.
template <class Holds>
double last_time(const Holds& holds, double from, double guess) {
  std::int64_t low = order_of(from), high = order_of(infinity);  // it holds at of_order(low), but not at of_order(high)
  const auto probe = [&](std::int64_t order) {
    if (order > low && order < high) (holds(of_order(order)) ? low : high) = order;
  };
  if (std::isfinite(guess)) {
    const std::int64_t about = order_of(guess);
    probe(about);
    for (int shift = 0; shift < 48; shift += 4) {
      probe(about + (std::int64_t{1} << shift));
      probe(about - (std::int64_t{1} << shift));
    }
  }
  while (low + 1 < high) {
    const std::int64_t middle = std::midpoint(low, high);  // their difference might overflow
    if (holds(of_order(middle))) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return of_order(low);
}

/// Until when a line is not negative, rounded down. Precondition: it is not negative at `from`.
double last_time(const Line<Exact>& line, double from) {
  if (sign(line.slope) >= 0) return infinity;
  const double guess = CGAL::to_double(line.offset) / CGAL::to_double(-line.slope);
  return last_time([&](double t) { return sign(value_at(line, t)) >= 0; }, from, guess);
}

template <int Dim, class A, class B>
double exact_failure_time(const A& a, const B& b, const Point<Dim>& n, double g, double from) {
  const Line<Exact> line = margin<Exact, Dim>(a, b, n, g);
  return sign(value_at(line, from)) <= 0 ? from : last_time(line, from);
}

// --- Walls and balls ---

template <int Dim>
double end_of(const Ray<Dim>& p, const MovingWall<Dim>& wall, double from) {
  const double side = wall.above ? 1 : -1, rise = side * (dot<double, Dim>(wall.n, p.v) - wall.rate);
  const auto size = dot<detail::Magnitude, Dim>(wall.n, p.v) + detail::Magnitude(wall.rate);
  if (rise > 0x1p-48 * size.size && rounding_self_test().nearest_ok) return infinity;
  const Exact slope = Exact(side) * (dot<Exact, Dim>(wall.n, p.v) - Exact(wall.rate));
  return last_time(Line<Exact>{detail::room<Exact>(p, wall, 0), slope, Exact(1)}, from);
}

template <int Dim>
double end_of(const Ray<Dim>& p, const MovingBall<Dim>& ball, double from) {
  if (p.v == ball.centre.v) return infinity;
  double a = 0, b = 0;  // |d + tau w|^2 = |d|^2 + 2 b tau + a tau^2
  for (std::size_t k = 0; k < Dim; ++k) {
    const Ray<Dim>& c = ball.centre;
    const double d = p.x[k] + p.v[k] * (from - p.t) - (c.x[k] + c.v[k] * (from - c.t)), w = p.v[k] - c.v[k];
    a += w * w;
    b += w * d;
  }
  const double left = detail::room<double>(p, ball, from), root = std::sqrt(b * b + a * left);
  const double guess = from + (b > 0 ? left / (b + root) : (root - b) / a);
  return last_time([&](double t) { return holds_at(p, ball, t); }, from, guess);
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

template <int Dim, class Certificate>
bool detail::holds_exactly(const Ray<Dim>& p, const Certificate& certificate, double s) {
  if (rounding_self_test().directed_ok) {
    const Interval::Protector upward;
    const Interval left = room<Interval>(p, certificate, s);
    if (left.inf() >= 0) return true;
    if (left.sup() < 0) return false;
  }
  return sign(room<Exact>(p, certificate, s)) >= 0;
}

template <int Dim, class Certificate>
double failure_time(const Ray<Dim>& p, const Certificate& certificate, double from) {
  return holds_at(p, certificate, from) ? end_of(p, certificate, from) : from;
}

template double failure_time(const Ray<2>&, const Ray<2>&, const Point2&, double, double);
template double failure_time(const Ray<2>&, const MotionSegment<2>&, const Point2&, double, double);
template double failure_time(const MotionSegment<2>&, const Ray<2>&, const Point2&, double, double);
template double failure_time(const MotionSegment<2>&, const MotionSegment<2>&, const Point2&, double, double);
template double failure_time(const Ray<3>&, const Ray<3>&, const Point3&, double, double);
template double failure_time(const Ray<3>&, const MotionSegment<3>&, const Point3&, double, double);
template double failure_time(const MotionSegment<3>&, const Ray<3>&, const Point3&, double, double);
template double failure_time(const MotionSegment<3>&, const MotionSegment<3>&, const Point3&, double, double);

template bool detail::holds_exactly(const Ray<2>&, const MovingWall<2>&, double);
template bool detail::holds_exactly(const Ray<2>&, const MovingBall<2>&, double);
template bool detail::holds_exactly(const Ray<3>&, const MovingWall<3>&, double);
template bool detail::holds_exactly(const Ray<3>&, const MovingBall<3>&, double);
template double failure_time(const Ray<2>&, const MovingWall<2>&, double);
template double failure_time(const Ray<2>&, const MovingBall<2>&, double);
template double failure_time(const Ray<3>&, const MovingWall<3>&, double);
template double failure_time(const Ray<3>&, const MovingBall<3>&, double);

}  // namespace noli
