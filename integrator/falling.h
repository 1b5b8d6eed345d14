// SPDX-License-Identifier: Apache-2.0
//
// Gravity. It acts on a vertex together with the vertex's other forces. At vertices on which no other force acts, it
// has a clock of its own.
//
// Notation
//   h      step of gravity at a vertex: the shortest step of the forces on it, but at most gravity's own step
//   h(1)   step of the first layer of a material of contact
//   since  the last time at which gravity acted on a vertex
//   until  the time at which it is expected to act again, the first of: the next time k h; the window's end; and, as
//          long as contact strikes the vertex and if h(1) is less than h, the next time k h(1)
//   lead   (until - since) / 2: from `since` on a vertex has the velocity of the time since + lead, with which it is on
//          its parabola at `until`
//
// So an event at t is a kick of g (t - since - lead + lead'), lead' being the lead from t on: half of the previous step
// and half of the next. With equal steps this is leapfrog. With any steps, a freely falling vertex is on its parabola
// whenever gravity acts as expected.
//
// A first impulse may come at any time, and cuts a step of p to s. The vertex is then g s (p - s) / 2 short of its
// parabola, and has lost m g^2 s (p - s) / 2, that is m g^2 h^2 / 12 on average. The books count it as an effect of
// finite steps. While impulses follow, steps are as expected. (If gravity acted with each impulse, all steps would be
// cut in the same direction: a ball that bounces with speed v would gain m v g h(1) / 2 each time.)
//
// Steps depend only on the motion: on its impulses, not on which layers are active. So in numbers of other precisions
// they follow from each run's own impulses. At a window's end gravity acts on all vertices and forgets which were
// struck, so its state follows from the time.
//
// Callers must have certificates check the vertices whose velocities change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "integrator/books.h"
#include "integrator/clocks.h"
#include "integrator/kick.h"
#include "integrator/model.h"

namespace noli::integrator {

template <class S, int Dim>
class Falling {
 public:
  /// Without gravity.
  Falling() = default;

  /// `masses`, `steps`: by vertex, [kg] and h; infinity for vertices that do not fall. Both must outlive this.
  /// `layer_steps`: h(1) of each material.
  Falling(const Vec<S, Dim>& acceleration, std::span<const S> masses, std::span<const double> steps,
          const std::vector<double>& layer_steps)
      : acceleration_(acceleration), masses_(masses), steps_(steps), falls_(steps.size()) {
    for (const double h : layer_steps) struck_.push_back({{h, 1}, {}});
    for (VertexId i = 0; i < falls_.size(); ++i) falls_[i].own = first_own(i, 0);
  }

  bool empty() const { return falls_.empty(); }
  bool falls(VertexId i) const { return steps_[i] < never; }
  const Vec<S, Dim>& acceleration() const { return acceleration_; }
  /// Precondition: gravity has acted on the vertex at this time, or never.
  double lead(VertexId i) const { return 0.5 * (falls_[i].until - falls_[i].since); }

  /// Begins a window that is expected to end at `end`. Forgets which vertices were struck.
  void begin_window(double end) {
    window_end_ = end;
    for (Struck& struck : struck_) struck.vertices.clear();
    for (Fall& fall : falls_) {
      fall.struck = never;
      fall.is_struck = false;
    }
    next_struck_ = never;
  }

  /// Restores the state at time t > 0 at which a window begins.
  void resume(double t) {
    for (VertexId i = 0; i < falls_.size(); ++i) {
      falls_[i] = {t, t, first_own(i, t), never, false};
      falls_[i].until = expected(falls_[i], t);
    }
  }

  /// Acts on a vertex, if it falls, as an event of its own. Returns whether the velocity has changed.
  template <class Recorder>
  bool act(const Kicked<S, Dim, Recorder>& now, VertexId i, Account<S, Dim>& account) {
    return falls(i) && act_for(advance(falls_[i], now.t), now, i, account);
  }

  /// The same at one of the times k h; the next one is `next`. Precondition: the vertex falls.
  template <class Recorder>
  bool act_at_own(const Kicked<S, Dim, Recorder>& now, VertexId i, double next, Account<S, Dim>& account) {
    falls_[i].own = next;
    return act_for(advance(falls_[i], now.t), now, i, account);
  }

  /// A layer of this material has given a vertex an impulse at time t.
  void strike(VertexId i, std::uint16_t material, double t) {
    if (empty() || !falls(i) || !(struck_[material].clock.step < steps_[i])) return;
    falls_[i].is_struck = true;
    await(i, struck_[material], t);
  }

  /// The next time at which gravity acts on struck vertices.
  double next_struck() const { return next_struck_; }

  /// Calls each(vertex) for the vertices on which it acts at next_struck(). Vertices struck since the last time are
  /// expected again at the next time.
  template <class Each>
  void take_struck(const Each& each) {
    const double t = next_struck_;
    for (Struck& struck : struck_) {
      if (struck.vertices.empty() || struck.clock.time() != t) continue;
      taken_.clear();
      taken_.swap(struck.vertices);
      ++struck.clock.next;
      for (const VertexId i : taken_) {
        Fall& fall = falls_[i];
        if (fall.struck != t) continue;
        fall.struck = never;
        if (std::exchange(fall.is_struck, false)) expect(i, struck);
        each(i);
      }
    }
    next_struck_ = never;
    for (const Struck& struck : struck_) {
      if (!struck.vertices.empty()) next_struck_ = std::min(next_struck_, struck.clock.time());
    }
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  struct Fall {
    double since = 0, until = 0;
    double own = never;     ///< the next of the times k h
    double struck = never;  ///< the next of the times k h(1), if it is expected because of impulses
    bool is_struck = false;
  };

  /// The vertices that one material strikes, and the next time of its first layer.
  struct Struck {
    Clock clock;
    std::vector<VertexId> vertices;  ///< includes some that are not expected any more
  };

  double first_own(VertexId i, double t) const {
    return falls(i) ? static_cast<double>(first_after(t, steps_[i])) * steps_[i] : never;
  }

  double expected(const Fall& fall, double t) const {
    const double next = std::min(fall.own, fall.struck);
    return window_end_ > t ? std::min(next, window_end_) : next;
  }

  /// Advances a vertex to an event at time t. Returns the length of the kick [s].
  S advance(Fall& fall, double t) const {
    const S lead = S(0.5) * (S(fall.until) - S(fall.since)), elapsed = S(t) - S(fall.since);
    fall.since = t;
    fall.until = expected(fall, t);
    return (elapsed - lead) + S(0.5) * (S(fall.until) - S(t));
  }

  template <class Recorder>
  bool act_for(const S& duration, const Kicked<S, Dim, Recorder>& now, VertexId i, Account<S, Dim>& account) const {
    if (duration == S(0)) return false;
    const Particle<S, Dim>& p = now.particles[i];
    const Vec<S, Dim> x = p.at(now.t), v = p.v + duration * acceleration_;
    const Vec<S, Dim> impulse = (masses_[i] * duration) * acceleration_;
    account.work += S(0.5) * impulse.dot(Vec<S, Dim>(p.v + v));
    account.impulse += impulse;
    account.angular_impulse += moment<S, Dim>(x, impulse);
    ++account.events;
    set_velocity(now, i, x, v);
    return true;
  }

  void await(VertexId i, Struck& struck, double t) {
    if (struck.vertices.empty()) struck.clock.next = first_after(t, struck.clock.step);
    if (struck.clock.time() < falls_[i].struck) expect(i, struck);
  }

  void expect(VertexId i, Struck& struck) {
    falls_[i].struck = struck.clock.time();
    struck.vertices.push_back(i);
    next_struck_ = std::min(next_struck_, falls_[i].struck);
  }

  Vec<S, Dim> acceleration_ = Vec<S, Dim>::Zero();
  std::span<const S> masses_;
  std::span<const double> steps_;  ///< h
  std::vector<Fall> falls_;
  std::vector<Struck> struck_;   ///< by material
  std::vector<VertexId> taken_;  ///< for take_struck
  double next_struck_ = never;
  double window_end_ = 0;
};

}  // namespace noli::integrator
