// SPDX-License-Identifier: Apache-2.0
//
// A vertex's plan: a straight motion, and a ball around it that the vertex must not leave for some time. As long as it
// does not, every conclusion from the plan holds. And a pen: a plan of a vertex with many walls, chosen so that most of
// them do not reach into it.
//
// Notation: that of certificates/cells.h, and
//   deviation   x(t) - line(t), which is linear between changes of velocity: if it is within the ball at two times, it
//               also is in between
//   gates   walls that reach into the pen
// As long as a vertex stays in its pen, only its gates need to be checked. A struck vertex changes its velocity with
// every impulse and has hundreds of walls; checking all of them each time was nearly all the cost of its certificates.
//
// The caller that puts up a slab must say whether it reaches into the pen.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "certificates/near_pair.h"
#include "certificates/vector.h"

namespace noli::certificates {

template <int Dim>
struct Plan {
  Line<Dim> line;
  double radius = 0;
  double until = 0;
};

/// The least tau >= 0 at which |e + tau w| = radius; infinity if it never is. Precondition: |e| <= radius.
template <int Dim>
double time_to_leave(const Vector<Dim>& e, const Vector<Dim>& w, double radius) {
  const double a = w.squaredNorm(), b = e.dot(w), c = e.squaredNorm() - radius * radius;
  if (!(a > 0)) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  return b > 0 ? std::max(-c, 0.0) / (b + root) : (root - b) / a;
}

template <int Dim>
class Pen {
 public:
  using Clearance = std::pair<double, Side>;

  /// Before it is put up, it holds no vertex.
  bool is_up(double t) const { return t <= plan_.until; }
  void take_down() { plan_.until = -std::numeric_limits<double>::infinity(); }

  /// How long it should be put up, as a multiple of the length of the vertex's next plan.
  double plans() const { return plans_; }

  /// Puts it up around a motion from now until `until`, no wider than `widest`. `clearances`: the least clearance until
  /// then, for all walls of the vertex; this reorders them. Keeps `margin` clear of walls that are not gates.
  void put_up(const Line<Dim>& now, double until, double widest, std::vector<Clearance>& clearances, double margin) {
    const auto gates = static_cast<std::ptrdiff_t>(clearances.size() / walls_a_gate);
    const auto first = clearances.begin() + gates;
    std::nth_element(clearances.begin(), first, clearances.end(),
                     [](const Clearance& a, const Clearance& b) { return a.first < b.first; });
    const double radius = std::min(widest, first->first - margin);
    if (!(radius > 0)) {
      plans_ = std::max(plans_ / 4, least_plans);
      return;
    }
    plan_ = {now, radius, until};
    gates_.clear();
    for (auto wall = clearances.begin(); wall != first; ++wall) gates_.push_back(wall->second);
  }

  /// Whether a vertex with this motion is well inside, and will be for some time.
  bool holds(const Line<Dim>& now) const { return is_up(now.t) && !is_old(now.t) && has_well_inside(now); }

  /// Call this when it does not hold its vertex any more.
  void take_down(const Line<Dim>& now) {
    if (is_up(now.t) && is_old(now.t) && has_well_inside(now)) plans_ = std::min(2 * plans_, most_plans);
    take_down();
  }

  const Plan<Dim>& plan() const { return plan_; }
  std::span<const Side> gates() const { return gates_; }

  void add_gate(Side side) {
    if (std::find(gates_.begin(), gates_.end(), side) == gates_.end()) gates_.push_back(side);
  }

 private:
  bool is_old(double t) const { return 4 * (plan_.until - t) < plan_.until - plan_.line.t; }
  bool has_well_inside(const Line<Dim>& now) const {
    return (now.x - plan_.line.at(now.t)).squaredNorm() <= 0.25 * plan_.radius * plan_.radius;
  }

  static constexpr std::size_t walls_a_gate = 16;
  static constexpr double least_plans = 4, most_plans = 64;

  Plan<Dim> plan_{{}, 0, -std::numeric_limits<double>::infinity()};
  std::vector<Side> gates_;
  double plans_ = most_plans;
};

}  // namespace noli::certificates
