// SPDX-License-Identifier: Apache-2.0
//
// A layer of contact fires for a pair: its vertices get their new velocities, the books what that took.
//
// Notation: that of integrator/contact_impulse.h, and
//   blow      one layer, one pair, one time
//   course    which way the formulas went. Arithmetic of another precision may take another one
//
// What this does not do: it says neither when a layer fires nor for which pairs (integrator/contact.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "certificates/closest.h"
#include "integrator/books.h"
#include "integrator/contact_extremes.h"
#include "integrator/contact_impulse.h"
#include "integrator/kick.h"

namespace noli::integrator {

/// What a layer does to all its pairs.
struct LayerTerms {
  double thickness = 0;    ///< eta(l) [m]
  double stiffness = 0;    ///< r(l) [N/m]
  double restitution = 1;  ///< e
  double friction = 0;     ///< mu
};

struct Course {
  bool acts = false;         ///< g < 0
  bool parts = false;        ///< the closest points part, so that restitution counts
  bool sticks = false;       ///< friction stops all slip
  std::uint8_t corners = 0;  ///< bit i: vertex i has a part in the closest points

  friend bool operator==(const Course&, const Course&) = default;
};

template <class S, int Dim>
struct Blow {
  certificates::Closest<Dim, S> closest;
  S distance;
  Course course;  ///< corners are not in it
  bool struck = false;

  Course whole_course() const {
    Course whole = course;
    for (std::size_t i = 0; i < 4; ++i) whole.corners |= static_cast<std::uint8_t>((closest.weights[i] != S(0)) << i);
    return whole;
  }
};

/// The vertices of a pair at one time.
template <class S, int Dim>
class PairState {
 public:
  template <class Recorder>
  PairState(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair) : size_(pair.size()) {
    for (std::size_t i = 0; i < size_; ++i) {
      const auto& p = now.particles[pair.vertices[i]];
      x_[i] = p.at(now.t);
      v_[i] = p.v;
      inverse_mass_[i] = p.inverse_mass;
    }
  }

  std::span<const Vec<S, Dim>> xs() const { return {x_.data(), size_}; }
  std::span<const Vec<S, Dim>> vs() const { return {v_.data(), size_}; }
  std::span<const S> inverse_masses() const { return {inverse_mass_.data(), size_}; }

  void give(const Impulses<Dim, S>& impulses) {
    for (std::size_t i = 0; i < size_; ++i) {
      if (inverse_mass_[i] != S(0)) v_[i] += inverse_mass_[i] * impulses[i];
    }
  }

  const std::array<Vec<S, Dim>, 4>& velocities() const { return v_; }

  template <class Recorder>
  void settle(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair) const {
    for (std::size_t i = 0; i < size_; ++i) {
      const VertexId vertex = pair.vertices[i];
      if (inverse_mass_[i] == S(0) || !differ<S, Dim>(v_[i], now.particles[vertex].v)) continue;
      set_velocity(now, vertex, x_[i], v_[i]);
    }
  }

 private:
  std::size_t size_;
  std::array<Vec<S, Dim>, 4> x_, v_;
  std::array<S, 4> inverse_mass_{};
};

/// Of friction up to a magnitude `most`: the impulses, all zero if nothing slips.
template <class S, int Dim>
struct Friction {
  Impulses<Dim, S> impulses;
  bool sticks = true;  ///< it stops all slip
};

template <class S, int Dim>
Friction<S, Dim> rub(PairState<S, Dim>& state, const certificates::Closest<Dim, S>& c, const S& most) {
  const Slip<Dim, S> s = slip<Dim, S>(c, state.xs(), state.vs());
  Friction<S, Dim> friction{s.against};
  const S yield = yielding<Dim, S>(s, state.inverse_masses());
  if (!(s.speed > S(0)) || !(yield > S(0))) {
    for (auto& impulse : friction.impulses) impulse.setZero();
    return friction;
  }
  const S stop = s.speed / yield, magnitude = std::min(most, stop);
  for (auto& impulse : friction.impulses) impulse *= magnitude;
  state.give(friction.impulses);
  friction.sticks = !(most < stop);
  return friction;
}

/// What a layer gives a pair, all in one event.
template <class S, int Dim>
struct PairImpulses {
  Impulses<Dim, S> potential;  ///< of the layer's potential
  Impulses<Dim, S> normal;     ///< of these, what restitution leaves
  Impulses<Dim, S> friction;   ///< of which normal impulses are the measure
  bool withheld = false;       ///< `normal` is not `potential`
  bool rubs = false;           ///< there is friction
};

/// Books what a layer has given a pair, which moved with the velocities `before` and is `after` now.
template <class S, int Dim, class Recorder>
void book_pair(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair,
               const std::array<Vec<S, Dim>, 4>& before, const PairState<S, Dim>& after,
               const PairImpulses<S, Dim>& given, Account<S, Dim>& account) {
  S potential(0), normal(0), friction(0);
  for (std::size_t i = 0; i < pair.size(); ++i) {
    const Vec<S, Dim>& v = after.vs()[i];
    Vec<S, Dim> twice_mean = before[i] + v;
    if (after.inverse_masses()[i] == S(0)) {
      const Vec<S, Dim> whole = given.rubs ? Vec<S, Dim>(given.normal[i] + given.friction[i]) : given.normal[i];
      const Held<S, Dim> held{pair.vertices[i], now.t, after.xs()[i], v};
      twice_mean = S(2) * book_held<S, Dim>(account, *now.scripts, held, whole);
    }
    normal += given.normal[i].dot(twice_mean);
    if (given.withheld) potential += given.potential[i].dot(twice_mean);
    if (given.rubs) friction += given.friction[i].dot(twice_mean);
  }
  account.work += S(0.5) * (given.withheld ? potential : normal);
  if (given.withheld) account.restitution_work += S(0.5) * (normal - potential);
  account.damping_work += S(0.5) * friction;
}

/// Fires a layer for a pair, for h seconds. Throws ContactLimit at distance 0. Room in the recording is the caller's
/// business.
template <class S, int Dim, class Recorder>
Blow<S, Dim> strike_pair(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair,
                         const LayerTerms& layer, double h, Account<S, Dim>& account) {
  PairState<S, Dim> state(now, pair);
  Blow<S, Dim> blow;
  blow.closest = certificates::closest<Dim, S>(pair.kind, state.xs());
  blow.distance = blow.closest.distance();
  const S g = blow.distance - S(layer.thickness);
  if (!(g < S(0))) return blow;
  if (!(blow.distance > S(0))) throw ContactLimit(pair, now.t);
  blow.course.acts = true;
  blow.course.parts = opening_speed<Dim, S>(blow.closest, blow.distance, state.vs()) > S(0);
  const double share = blow.course.parts ? layer.restitution : 1;
  const S push = S(-share) * S(h) * S(layer.stiffness) * g;
  const std::array<Vec<S, Dim>, 4> before = state.velocities();
  PairImpulses<S, Dim> given;
  given.withheld = share != 1;
  if (given.withheld) {
    given.potential = normal_impulses<Dim, S>(blow.closest, blow.distance, S(-1) * S(h) * S(layer.stiffness) * g);
  }
  given.normal = normal_impulses<Dim, S>(blow.closest, blow.distance, push);
  if (push != S(0)) {
    blow.struck = true;
    state.give(given.normal);
  }
  given.rubs = blow.struck && layer.friction > 0;
  if (given.rubs) {
    const Friction<S, Dim> friction = rub<S, Dim>(state, blow.closest, S(layer.friction) * push);
    blow.course.sticks = friction.sticks;
    given.friction = friction.impulses;
  }
  book_pair(now, pair, before, state, given, account);
  if (blow.struck) state.settle(now, pair);
  return blow;
}

/// The closest points of a pair whose vertices are at position(vertex).
template <class S, int Dim, class PositionOf>
certificates::Closest<Dim, S> closest_of(const certificates::Stencil& pair, const PositionOf& position) {
  std::array<Vec<S, Dim>, 4> x;
  for (std::size_t i = 0; i < pair.size(); ++i) x[i] = position(pair.vertices[i]);
  return certificates::closest<Dim, S>(pair.kind, std::span<const Vec<S, Dim>>(x.data(), pair.size()));
}

}  // namespace noli::integrator
