// SPDX-License-Identifier: Apache-2.0
//
// Decides whether a certificate holds until a time, for the extrapolated motion over the reals: by a static bound for
// the rounding of doubles, and if that is not enough, by kernel/failure_time. Schedulers may choose and compute times
// in any way; the answer here is never true for a time that is too late.
//
// Notation: that of certificates/cells.h and of kernel/failure_time.h, and
//   reach       a bound of all coordinates of vertices and their plans in this slice, up to some roundings; of tubes
//               from the slice's begin
//   rounding    2^-44 reach: a bound of the rounding in a clearance, a deviation or a gap computed in double
//   recording   2^-47 reach: how far recorded positions, and those that a layer computes, may differ from extrapolated
//               ones, for each side of a pair (proofs/theory.md, C1). Walls keep it clear; certificates include it
//
// The static bound can only confirm. For a ball: let a vertex be within it at its last breakpoint, and let its computed
// deviation be less than the radius. Then it has moved no farther than twice the reach at any velocity, so its
// deviation is known to some 20 units of 2^-53 of the reach.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "certificates/near_pair.h"
#include "certificates/pen.h"
#include "certificates/vector.h"
#include "kernel/failure_time.h"

namespace noli::certificates {

template <int Dim>
Point<Dim> point_of(const Vector<Dim>& x) {
  Point<Dim> point;
  std::copy_n(x.data(), Dim, point.begin());
  return point;
}

template <int Dim>
Ray<Dim> ray_of(const Line<Dim>& line) {
  return {line.t, point_of<Dim>(line.x), point_of<Dim>(line.v)};
}

/// The wall that vertices of A, or of B, must stay beyond, at least `clear` away from the slab.
template <int Dim>
MovingWall<Dim> wall_of(const Slab<Dim>& slab, bool of_a, double clear) {
  constexpr double up = 1 + 0x1p-50;  // more than two roundings
  return {point_of<Dim>(slab.normal), slab.offset, slab.rate, slab.since, (slab.half + clear) * up, of_a};
}

/// `Host` may have decided(ray, certificate, from, until, holds), which is then called for each decision.
template <int Dim, class Host>
class Decisions {
 public:
  explicit Decisions(Host& host) : host_(host) {}

  /// Call this when a slice begins.
  void forget_reach() { reach_ = 0; }
  /// Call this before any decision about a line until `end`.
  void reach_out(const Line<Dim>& line, double end) {
    const double way = line.v.cwiseAbs().maxCoeff() * (end - line.t);
    reach_ = std::max(reach_, line.x.cwiseAbs().maxCoeff() + way);
  }
  void reach_out(const Plan<Dim>& plan) {
    reach_out(plan.line, plan.until);
    reach_ = std::max(reach_, plan.radius);
  }
  double rounding() const { return 0x1p-44 * reach_; }
  double recording() const { return 0x1p-47 * reach_; }

  /// Whether a motion stays within a plan until `time`. Precondition: it is there now.
  bool holds(const Plan<Dim>& plan, const Line<Dim>& motion, double time) const {
    if (!(time <= plan.until)) return false;
    const double r = plan.radius, room = r * r - (motion.at(time) - plan.line.at(time)).squaredNorm();
    if (!std::isfinite(room)) return false;
    const bool deep = room > 2 * r * rounding();
    if (deep && !tells) return true;
    const Ray<Dim> ray = ray_of<Dim>(motion);
    const MovingBall<Dim> ball{ray_of<Dim>(plan.line), r};
    return tell(ray, ball, time, time, deep || holds_at(ray, ball, time));
  }

  /// Whether all of a plan stays beyond a wall, from t until its end. Precondition: t <= plan.until.
  bool stays_beyond(const Plan<Dim>& plan, const Slab<Dim>& slab, bool of_a, double t) const {
    const double clear = plan.radius + recording();
    const double room =
        std::min(slab.clearance(of_a, plan.line.at(t), t), slab.clearance(of_a, plan.line.at(plan.until), plan.until)) -
        clear;
    if (!std::isfinite(room)) return false;
    const bool far = room > rounding();
    if (far && !tells) return true;
    const Ray<Dim> ray = ray_of<Dim>(plan.line);
    const MovingWall<Dim> wall = wall_of<Dim>(slab, of_a, clear);
    return tell(ray, wall, t, plan.until, far || holds_until(ray, wall, t, plan.until));
  }

  /// When a vertex reaches its wall, rounded down, but not before t and not after `latest`. Precondition: t <= latest.
  double time_of_failure(const Line<Dim>& motion, const Slab<Dim>& slab, bool of_a, double t, double latest) const {
    const Ray<Dim> ray = ray_of<Dim>(motion);
    const MovingWall<Dim> wall = wall_of<Dim>(slab, of_a, recording());
    const bool later = std::isfinite(latest) && holds_until(ray, wall, t, latest);
    const double end = later ? latest : std::min(latest, failure_time(ray, wall, t));
    if (end > t) tell(ray, wall, t, end, true);
    return end;
  }

 private:
  static constexpr bool tells = requires(Host & host, const Ray<Dim>& ray, const MovingBall<Dim>& ball) {
    host.decided(ray, ball, 0.0, 0.0, true);
  };

  template <class Certificate>
  bool tell(const Ray<Dim>& ray, const Certificate& certificate, double from, double until, bool holds) const {
    if constexpr (tells) host_.decided(ray, certificate, from, until, holds);
    return holds;
  }

  Host& host_;
  double reach_ = 0;
};

}  // namespace noli::certificates
