// SPDX-License-Identifier: Apache-2.0
//
// Until when does a certificate hold? The certificate: n . (a(t) - b(t)) > g for two points that move linearly.
//
// Notation
//   Ray             x(t) = x + (t - t_i) v: where an integrator extrapolates to from its last event
//   MotionSegment   the line through (t0, x0) and (t1, x1), t0 < t1: what was recorded
// Both are lines over the reals, without rounding. The failure time is rounded down: an event may come early, never
// late.
//
// What this does not do: it does not know that a ray ends at the next event or a segment at its last breakpoint.
#pragma once

#include <noli/query.h>

namespace noli {

template <int Dim>
struct Ray {
  static constexpr int dimension = Dim;
  double t;  ///< time of x
  Point<Dim> x;
  Point<Dim> v;  ///< length per time
};

template <int Dim>
struct MotionSegment {
  static constexpr int dimension = Dim;
  double t0;
  Point<Dim> x0;
  double t1;
  Point<Dim> x1;
};

/// The largest double that is not greater than the least t >= from at which n . (a(t) - b(t)) <= g; `from` if that is
/// so there; +infinity if it never is. a, b: Ray<Dim> or MotionSegment<Dim>. Preconditions: all numbers are finite; t0
/// < t1 in a segment.
template <class A, class B>
double failure_time(const A& a, const B& b, const Point<A::dimension>& n, double g, double from);

}  // namespace noli
