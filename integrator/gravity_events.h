// SPDX-License-Identifier: Apache-2.0
//
// Runs the events of gravity, and books them.
//
// Notation: that of integrator/falling.h and integrator/gravity_steps.h. A function returns the vertices whose
// velocities it changed only if no other event at that time has certificates check them.
//
// integrator/engine.h keeps the order of events.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "integrator/falling.h"
#include "integrator/gravity_steps.h"
#include "integrator/instant.h"

namespace noli::integrator {

template <class S, int Dim>
class GravityEvents {
 public:
  /// Without gravity.
  GravityEvents() = default;

  /// `of_forces`: by vertex, the shortest step of the forces on it. `masses` must outlive this.
  GravityEvents(const Model<S, Dim>& model, std::vector<double> of_forces, std::span<const S> masses)
      : steps_(steps_of_gravity(held_vertices(model), std::move(of_forces), *model.gravity)) {
    std::vector<double> layer_steps;
    if (model.contact) {
      for (const ContactMaterial& m : model.contact->materials) layer_steps.push_back(m.step);
    }
    falling_ = Falling<S, Dim>(model.gravity->acceleration, masses, steps_.steps, layer_steps);
  }

  bool empty() const { return falling_.empty(); }
  const GravitySteps& steps() const { return steps_; }
  const Falling<S, Dim>& falling() const { return falling_; }
  Falling<S, Dim>& falling() { return falling_; }

  /// Acts on all vertices, when a run begins.
  template <class Recorder>
  void start(const Kicked<S, Dim, Recorder>& now, std::span<const VertexId> all, Instant<S, Dim>& instant,
             Account<S, Dim>& account) {
    fall(now, all, false, instant, account, [&](VertexId i, Account<S, Dim>& sum) { falling_.act(now, i, sum); });
  }

  /// Acts on the vertices of one step. `last`: nothing else strikes at this time.
  template <class Recorder>
  void fire(const Kicked<S, Dim, Recorder>& now, const Group& slot, bool last, Instant<S, Dim>& instant,
            Account<S, Dim>& account) {
    const double next = slot.clock.time();
    const auto act = [&](VertexId i, Account<S, Dim>& sum) { falling_.act_at_own(now, i, next, sum); };
    fall(now, slot.vertices, last, instant, account, act);
  }

  /// Acts on vertices that contact strikes.
  template <class Recorder>
  std::span<const VertexId> fire_where_struck(const Kicked<S, Dim, Recorder>& now, Account<S, Dim>& account) {
    struck_.clear();
    falling_.take_struck([this](VertexId i) { struck_.push_back(i); });
    return fall_alone(now, struck_, account);
  }

  /// Acts on all vertices, at the end of every window, so that its state follows from the time. `next_end`: the end of
  /// the window that begins.
  template <class Recorder>
  std::span<const VertexId> end_window(const Kicked<S, Dim, Recorder>& now, double next_end,
                                       std::span<const VertexId> all, Account<S, Dim>& account) {
    falling_.begin_window(next_end);
    return fall_alone(now, all, account);
  }

  /// Acts on the vertices that these forces carry. It is booked by the kind of the forces until close_books(), as sums
  /// must not depend on the lengths of rows.
  template <class Recorder, class F>
  void fire_with(const Kicked<S, Dim, Recorder>& any_time, std::span<const F> forces,
                 std::span<const DueForce> firing) {
    Account<S, Dim>& account = carried_books_[static_cast<std::size_t>(F::kind)];
    any_time.record.reserve(F::size * firing.size());
    for (const DueForce& due : firing) {
      for (unsigned bits = due.carries; bits != 0; bits &= bits - 1) {
        const VertexId i = forces[due.force].vertices[static_cast<unsigned>(std::countr_zero(bits))];
        falling_.act_at_own(at(any_time, due.t), i, due.next, account);
      }
    }
  }

  void close_books(Account<S, Dim>& account) {
    for (Account<S, Dim>& carried : carried_books_) account += std::exchange(carried, {});
  }

 private:
  template <class Recorder>
  static Kicked<S, Dim, Recorder> at(const Kicked<S, Dim, Recorder>& now, double t) {
    return {now.particles, now.record, t, now.scripts};
  }

  /// Acts as part of an instant, which books the work.
  template <class Recorder, class Act>
  void fall(const Kicked<S, Dim, Recorder>& now, std::span<const VertexId> vertices, bool last,
            Instant<S, Dim>& instant, Account<S, Dim>& account, const Act& act) {
    now.record.reserve(vertices.size());
    Account<S, Dim> sum;
    const auto velocity = [&](VertexId i) -> const Vec<S, Dim>& { return now.particles[i].v; };
    const auto fallen = [&](VertexId i) -> const Particle<S, Dim>& {
      act(i, sum);
      return now.particles[i];
    };
    instant.template begin<false>(ForceKind::gravity, last, vertices, velocity);
    instant.template end<false>(fallen);
    sum.work = S(0);
    account += sum;
  }

  template <class Recorder>
  std::span<const VertexId> fall_alone(const Kicked<S, Dim, Recorder>& now, std::span<const VertexId> vertices,
                                       Account<S, Dim>& account) {
    now.record.reserve(vertices.size());
    Account<S, Dim> sum;
    moved_.clear();
    for (const VertexId i : vertices) {
      if (falling_.act(now, i, sum)) moved_.push_back(i);
    }
    account += sum;
    return moved_;
  }

  GravitySteps steps_;
  Falling<S, Dim> falling_;
  std::vector<VertexId> struck_, moved_;                    ///< for fire_where_struck, fall_alone
  std::array<Account<S, Dim>, force_kinds> carried_books_;  ///< of the window, by kind of the carrying force
};

}  // namespace noli::integrator
