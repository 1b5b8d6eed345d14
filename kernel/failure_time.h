// SPDX-License-Identifier: Apache-2.0
//
// Until when does a certificate hold? Three kinds: n . (a(t) - b(t)) > g for two points that move linearly; a point
// stays beyond a moving wall (slabs: Harmon et al. 2009, section 5); a point stays in a moving ball.
//
// Notation
//   Ray             x(t) = x + (t - t_i) v: where an integrator extrapolates to from its last event
//   MotionSegment   the line through (t0, x0) and (t1, x1), t0 < t1: what was recorded
//   wall            n . x = s(t) +- half, s(t) = offset + rate (t - since), as in certificates/near_pair.h; n need not
//                   be a unit vector
//   ball            of a radius about a centre that moves as a ray
// Points and centres move on lines over the reals, without rounding. The failure time is rounded down: an event may
// come early, never late.
//
// A point beyond a wall at two times is beyond it in between, as the condition is linear. The same holds for a ball, as
// the distance from its centre is a convex function of time.
//
// Stages for walls and balls: doubles with a bound, CGAL's intervals, CGAL's exact numbers. The bound is 2^-48 = 32 u
// of the same formula over magnitudes, in which each product is 2^-1022 larger. A result has at most 15 roundings or
// underflows of products. For a ball: a coordinate of d has 5, from a difference of times, a product (2), a sum and a
// difference; its square has twice that and 2 of its own; and there are 3 sums. 32 - 15 = 17 u are left for the bound's
// own rounding, which is about 1 u.
//
// certificates/decisions.h asks for walls and balls, after a static bound of its own.
//
// A ray or a segment counts as endless here: the caller knows the next event or the last breakpoint.
#pragma once

#include <cmath>
#include <cstddef>

#include <noli/query.h>
#include "kernel/arithmetic/rounding.h"

namespace noli {

template <int Dim>
struct Ray {
  static constexpr int dimension = Dim;
  double t;  ///< time of x
  Point<Dim> x;
  Point<Dim> v;  ///< length per time
};

template <int Dim>
struct MovingWall {
  Point<Dim> n;
  double offset, rate, since;
  double half;  ///< not negative
  bool above;   ///< the point has n . x >= s(t) + half, otherwise n . x <= s(t) - half
};

template <int Dim>
struct MovingBall {
  Ray<Dim> centre;
  double radius;  ///< not negative; a point at this distance is inside
};

template <int Dim>
struct MotionSegment {
  static constexpr int dimension = Dim;
  double t0;
  Point<Dim> x0;
  double t1;
  Point<Dim> x1;
};

/// The least t >= from at which n . (a(t) - b(t)) <= g, rounded down to double; `from` if it is so at `from`; +infinity
/// if it never is. a, b: Ray<Dim> or MotionSegment<Dim>. Preconditions: all numbers are finite; t0 < t1 in a segment.
template <class A, class B>
double failure_time(const A& a, const B& b, const Point<A::dimension>& n, double g, double from);

namespace detail {

/// A number's magnitude, for bounds of rounding errors.
struct Magnitude {
  double size;

  explicit Magnitude(double x) : size(std::abs(x)) {}
  friend Magnitude operator+(Magnitude a, Magnitude b) { return Magnitude(a.size + b.size); }
  friend Magnitude operator-(Magnitude a, Magnitude b) { return Magnitude(a.size + b.size); }
  friend Magnitude operator-(Magnitude a) { return a; }
  friend Magnitude operator*(Magnitude a, Magnitude b) { return Magnitude(a.size * b.size + 0x1p-1022); }
};

template <class T, std::size_t Dim>
T dot(const Point<Dim>& n, const Point<Dim>& x) {
  T sum = T(n[0]) * T(x[0]);
  for (std::size_t i = 1; i < Dim; ++i) sum = sum + T(n[i]) * T(x[i]);
  return sum;
}

/// How far a point is beyond a wall at time s, times |n|.
template <class T, int Dim>
T room(const Ray<Dim>& p, const MovingWall<Dim>& wall, double s) {
  const T height = dot<T, Dim>(wall.n, p.x) + dot<T, Dim>(wall.n, p.v) * (T(s) - T(p.t)) -
                   (T(wall.offset) + T(wall.rate) * (T(s) - T(wall.since)));
  return (wall.above ? height : -height) - T(wall.half);
}

/// The square of a ball's radius less the square of the distance from its centre at time s.
template <class T, int Dim>
T room(const Ray<Dim>& p, const MovingBall<Dim>& ball, double s) {
  const Ray<Dim>& c = ball.centre;
  const T tau = T(s) - T(p.t), of_centre = T(s) - T(c.t);
  T left = T(ball.radius) * T(ball.radius);
  for (std::size_t k = 0; k < Dim; ++k) {
    const T d = (T(p.x[k]) + T(p.v[k]) * tau) - (T(c.x[k]) + T(c.v[k]) * of_centre);
    left = left - d * d;
  }
  return left;
}

template <int Dim, class Certificate>
bool holds_exactly(const Ray<Dim>& p, const Certificate& certificate, double s);

}  // namespace detail

/// Whether a certificate, MovingWall<Dim> or MovingBall<Dim>, holds for a point at time s. Precondition: all numbers
/// are finite, here and below.
template <int Dim, class Certificate>
bool holds_at(const Ray<Dim>& p, const Certificate& certificate, double s) {
  if (rounding_self_test().nearest_ok) {
    const double room = detail::room<double>(p, certificate, s);
    const double bound = 0x1p-48 * detail::room<detail::Magnitude>(p, certificate, s).size;
    if (room > bound) return true;
    if (room < -bound) return false;
  }
  return detail::holds_exactly(p, certificate, s);
}

/// Whether a certificate holds throughout [from, s]. Precondition: from <= s.
template <int Dim, class Certificate>
bool holds_until(const Ray<Dim>& p, const Certificate& certificate, double from, double s) {
  return holds_at(p, certificate, s) && holds_at(p, certificate, from);
}

/// Until when a certificate holds without a break from `from` on, rounded down; `from` if it does not hold there;
/// +infinity if it always holds.
template <int Dim, class Certificate>
double failure_time(const Ray<Dim>& p, const Certificate& certificate, double from);

}  // namespace noli
