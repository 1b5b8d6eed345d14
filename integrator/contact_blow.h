// SPDX-License-Identifier: Apache-2.0
//
// Fires a layer of contact for a pair: sets the new velocities of its vertices, and books the work.
//
// Notation: that of integrator/contact_impulse.h, and
//   blow      one layer, one pair, one time
//   course    the branches taken in the formulas. Arithmetic of another precision may take other ones
//
// integrator/contact.h decides when a layer fires and for which pairs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "certificates/closest.h"
#include "integrator/anchors.h"
#include "integrator/books.h"
#include "integrator/contact_extremes.h"
#include "integrator/contact_impulse.h"
#include "integrator/kick.h"

namespace noli::integrator {

/// The parameters of a layer, the same for all its pairs.
struct LayerTerms {
  double thickness = 0;    ///< eta(l) [m]
  double stiffness = 0;    ///< r(l) [N/m]
  double restitution = 1;  ///< e
  double friction = 0;     ///< mu
  double anchor_life = 0;  ///< [s] (integrator/anchors.h)
  std::uint16_t material = 0;
  std::uint32_t layer = 1;  ///< l
};

struct Course {
  bool acts = false;         ///< g < 0
  bool parts = false;        ///< the closest points part, so that restitution counts
  bool sticks = false;       ///< the pair can slip, and friction does not exceed Coulomb's bound
  std::uint8_t corners = 0;  ///< bit i: vertex i has a nonzero weight in the closest points

  friend bool operator==(const Course&, const Course&) = default;
};

/// The closest points of a pair when a layer fires. They depend only on positions, so they are the same before and
/// after all kicks of that time.
template <class S, int Dim>
struct Approach {
  certificates::Closest<Dim, S> closest;
  S distance;

  /// `course` with its corners filled in.
  Course with_corners(Course course) const {
    for (std::size_t i = 0; i < 4; ++i) course.corners |= static_cast<std::uint8_t>((closest.weights[i] != S(0)) << i);
    return course;
  }
};

struct Blow {
  Course course;  ///< without corners
  bool struck = false;
};

/// An array of what(vertex) for the N vertices of a pair.
template <std::size_t N, class What>
auto each_of(const certificates::Stencil& pair, const What& what) {
  std::array<decltype(what(pair.vertices[0])), N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = what(pair.vertices[i]);
  return result;
}

/// Gives a vertex an impulse. Usually an earlier pair has already brought the vertex to this time and recorded it; then
/// only its velocity changes.
template <class S, int Dim, class Recorder>
void kick_vertex(const Kicked<S, Dim, Recorder>& now, VertexId vertex, const Vec<S, Dim>& impulse) {
  Particle<S, Dim>& p = now.particles[vertex];
  if (p.inverse_mass == S(0)) return;
  const Vec<S, Dim> v = p.v + p.inverse_mass * impulse;
  if (!differ<S, Dim>(v, p.v)) return;
  if (p.t == now.t) {
    p.v = v;
  } else {
    set_velocity(now, vertex, Vec<S, Dim>(p.at(now.t)), v);
  }
}

template <class S, int Dim, std::size_t N>
struct Friction {
  Impulses<Dim, S> impulses;          ///< all zero if nothing slips
  std::array<Vec<S, Dim>, N> before;  ///< velocities before the layer fired
  bool sticks = false;                ///< as in Course
};

/// How a pair is struck that is only a part of a contact (integrator/inclusion_exclusion.h).
template <class S>
struct Strength {
  S weight = S(1);            ///< of the pair; if it is below 0 the layer pulls, without friction
  std::optional<bool> parts;  ///< whether the contact parts, so that restitution counts; nothing: as this pair does
  S rubbing = S(1);           ///< a factor of friction's bound
};

/// The bound of friction, and the pull of an anchor.
template <class S>
struct Grip {
  S bound;                   ///< the greatest impulse, mu J_n [N s]
  S spring;                  ///< h r(l) [N s/m]
  S reach;                   ///< mu |g|: the distance from an anchor at which the spring's force is Coulomb's [m]
  S step;                    ///< h [s]
  std::array<S, 4>* anchor;  ///< its weights; null: the pair has none
};

/// The slide from the anchor to the closest points, after an anchor farther away than `reach` was dragged.
template <int Dim, class S>
typename Sliding<Dim, S>::Slide slide_from(const Sliding<Dim, S>& sliding, const certificates::Closest<Dim, S>& c,
                                           std::span<const Vec<S, Dim>> x, const Grip<S>& grip) {
  using std::sqrt;
  std::array<S, 4>& anchor = *grip.anchor;
  auto slide = sliding.solve(sliding.way_from(anchor, x));
  const S length = sqrt(sliding.squared(slide));
  if (!(length > grip.reach)) return slide;
  const S share = grip.reach / length;
  for (std::size_t i = 0; i < x.size(); ++i) anchor[i] = c.weights[i] + share * (anchor[i] - c.weights[i]);
  for (S& part : slide) part *= share;
  return slide;
}

/// The impulse of friction before Coulomb's bound is applied. Without an anchor it stops the slip.
///
/// With one it is that of a spring with critical damping. If it stopped all slip here as well, it would spend its whole
/// bound just after each kick of a force that presses the pair along, and later give less than the force: over many
/// kicks the pair would creep by half the way that such a kick carries it.
template <int Dim, class S>
typename Sliding<Dim, S>::Slide unbounded_friction(const Sliding<Dim, S>& sliding,
                                                   const certificates::Closest<Dim, S>& c,
                                                   std::span<const Vec<S, Dim>> x, const Grip<S>& grip,
                                                   const Slip<Dim, S>& s, const S& yield) {
  using std::sqrt;
  typename Sliding<Dim, S>::Slide z{S(0), S(0)};
  S damped(1);  // the share of the slip's speed that is taken
  if (grip.anchor != nullptr) {
    z = slide_from<Dim, S>(sliding, c, x, grip);
    for (S& part : z) part *= grip.spring;
    damped = std::min<S>(S(1), S(2) * sqrt(grip.spring * grip.step * yield));
  }
  if (!(yield > S(0))) return z;
  for (std::size_t k = 0; k < 2; ++k) z[k] += damped * s.rate[k] / yield;
  return z;
}

/// Kicks the pair's vertices, which the layer has pushed apart: against their slip, and back to their anchor. Sets what
/// friction did.
template <std::size_t N, class S, int Dim, class Recorder>
void rub(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair, const certificates::Closest<Dim, S>& c,
         const Grip<S>& grip, Friction<S, Dim, N>& friction) {
  using std::sqrt;
  const auto x = each_of<N>(pair, [&](VertexId i) -> Vec<S, Dim> { return now.particles[i].at(now.t); });
  const auto v = each_of<N>(pair, [&](VertexId i) { return now.particles[i].v; });
  const auto inverse_masses = each_of<N>(pair, [&](VertexId i) { return now.particles[i].inverse_mass; });
  for (auto& impulse : friction.impulses) impulse.setZero();
  const Sliding<Dim, S> sliding(c, x);
  if (!sliding.possible()) return;
  const Slip<Dim, S> s = slip<Dim, S>(sliding, v);
  const S yield = yielding<Dim, S>(s, inverse_masses);
  auto z = unbounded_friction<Dim, S>(sliding, c, x, grip, s, yield);
  const S magnitude = sqrt(sliding.squared(z));
  friction.sticks = !(grip.bound < magnitude);
  if (!(magnitude > S(0))) return;
  if (!friction.sticks) {
    for (S& part : z) part *= grip.bound / magnitude;
  }
  friction.impulses = sliding.against(z);
  for (std::size_t i = 0; i < N; ++i) kick_vertex<S, Dim>(now, pair.vertices[i], friction.impulses[i]);
}

/// The impulses that a layer has given a pair, in one event.
template <class S, int Dim, std::size_t N>
struct Given {
  S full;                                         ///< magnitude of the impulse of the layer's potential [N s]
  S push;                                         ///< the part of it that restitution leaves
  Vec<S, Dim> normal;                             ///< impulses are its multiples, by weight
  S before;                                       ///< opening() before it
  const Friction<S, Dim, N>* friction = nullptr;  ///< if there is any
};

/// opening() of a pair with its present velocities.
template <std::size_t N, class S, int Dim, class Recorder>
S opening_now(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair,
              const certificates::Closest<Dim, S>& closest) {
  return opening<Dim, S>(closest, N,
                         [&](std::size_t i) -> const Vec<S, Dim>& { return now.particles[pair.vertices[i]].v; });
}

/// Twice the mean of opening() before and after.
template <std::size_t N, class S, int Dim, class Recorder>
S twice_mean_opening(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair,
                     const Approach<S, Dim>& approach, const Given<S, Dim, N>& given) {
  if (given.friction != nullptr) return given.before + opening_now<N>(now, pair, approach.closest);
  S mobility(0);
  for (std::size_t i = 0; i < N; ++i) {
    const S& weight = approach.closest.weights[i];
    mobility += weight * weight * now.particles[pair.vertices[i]].inverse_mass;
  }
  return S(2) * given.before + given.push * approach.distance * mobility;
}

/// Books the impulses. The work of normal impulses needs only the velocity at which the closest points open.
template <std::size_t N, class S, int Dim, class Recorder>
void book_pair(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair, const Approach<S, Dim>& approach,
               const Given<S, Dim, N>& given, Account<S, Dim>& account) {
  S twice_opening = twice_mean_opening(now, pair, approach, given), twice_friction(0);
  for (std::size_t i = 0; i < N; ++i) {
    const Particle<S, Dim>& p = now.particles[pair.vertices[i]];
    if (given.friction != nullptr) twice_friction += given.friction->impulses[i].dot(given.friction->before[i] + p.v);
    if (p.inverse_mass != S(0)) continue;
    Vec<S, Dim> whole = normal_impulse<Dim, S>(approach.closest, given.normal, given.push, i);
    if (given.friction != nullptr) whole += given.friction->impulses[i];
    const Held<S, Dim> held{pair.vertices[i], now.t, p.at(now.t), p.v};
    const Vec<S, Dim> twice_more = S(2) * Vec<S, Dim>(book_held<S, Dim>(account, *now.scripts, held, whole) - p.v);
    twice_opening += approach.closest.weights[i] * approach.closest.r.dot(twice_more);
    if (given.friction != nullptr) twice_friction += given.friction->impulses[i].dot(twice_more);
  }
  const S mean_speed = S(0.5) * twice_opening / approach.distance;
  account.work += given.full * mean_speed;
  account.restitution_work += (given.push - given.full) * mean_speed;
  account.damping_work += S(0.5) * twice_friction;
}

/// strike_pair() for a pair of N vertices. Both are inlined: reading back a result just written byte by byte took a
/// tenth of the time of this function.
template <std::size_t N, class S, int Dim, class Recorder>
[[gnu::always_inline]] inline Blow strike_vertices(const Kicked<S, Dim, Recorder>& now,
                                                   const certificates::Stencil& pair, const Approach<S, Dim>& approach,
                                                   const LayerTerms& layer, double h, const Strength<S>& strength,
                                                   Anchors<S>& anchors, Account<S, Dim>& account) {
  Blow blow;
  const auto& [closest, distance] = approach;
  const S g = distance - S(layer.thickness);
  if (!(g < S(0))) return blow;
  if (!(distance > S(0))) throw ContactLimit(pair, now.t);
  const S before = opening_now<N>(now, pair, closest);
  blow.course.acts = true;
  blow.course.parts = strength.parts.value_or(before > S(0));
  const std::array<double, 2> shares{1, layer.restitution};  // avoids a branch that processors cannot predict
  const S spring = S(h) * S(layer.stiffness) * strength.weight;
  const S push = S(-shares[blow.course.parts]) * spring * g, full = S(-1) * spring * g;
  Given<S, Dim, N> given{full, push, closest.r / distance, before};
  blow.struck = push != S(0);
  Friction<S, Dim, N> friction;
  const bool rubs = layer.friction > 0 && strength.weight > S(0);
  if (rubs) friction.before = each_of<N>(pair, [&](VertexId i) { return now.particles[i].v; });
  for (std::size_t i = 0; blow.struck && i < N; ++i) {
    kick_vertex<S, Dim>(now, pair.vertices[i], normal_impulse<Dim, S>(closest, given.normal, push, i));
  }
  if (rubs) {
    const PairInLayer key{layer.material, layer.layer, pair.kind, pair.vertices};
    std::array<S, 4>* const anchor = anchors.renew(key, now.t, layer.anchor_life);
    const S bound = S(layer.friction) * strength.rubbing * push, reach = S(-layer.friction) * g;
    const Grip<S> grip{bound, strength.rubbing * spring, reach, S(h), anchor};
    rub<N>(now, pair, closest, grip, friction);
    blow.course.sticks = friction.sticks;
    const bool stopped = friction.sticks && blow.struck;
    if (stopped && anchor == nullptr) anchors.begin(key, closest.weights, now.t, layer.anchor_life);
    given.friction = &friction;
  }
  book_pair(now, pair, approach, given, account);
  return blow;
}

/// Fires a layer for a pair, for h seconds. Throws ContactLimit at distance 0. Precondition: the recording has room.
template <class S, int Dim, class Recorder>
[[gnu::always_inline]] inline Blow strike_pair(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair,
                                               const Approach<S, Dim>& approach, const LayerTerms& layer, double h,
                                               const Strength<S>& strength, Anchors<S>& anchors,
                                               Account<S, Dim>& account) {
  switch (pair.size()) {
    case 2: return strike_vertices<2>(now, pair, approach, layer, h, strength, anchors, account);
    case 3: return strike_vertices<3>(now, pair, approach, layer, h, strength, anchors, account);
    default: return strike_vertices<4>(now, pair, approach, layer, h, strength, anchors, account);
  }
}

/// Calls each(vertex) for the free vertices of a pair that an impulse between its closest points moves: those with a
/// nonzero weight.
template <class S, int Dim, class Each>
void for_each_struck(const certificates::Stencil& pair, const certificates::Closest<Dim, S>& closest, Each&& each) {
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (closest.weights[i] != S(0)) each(pair.vertices[i]);
  }
}

/// Finds the closest points of a pair whose vertices are at position(vertex).
template <class S, int Dim, class PositionOf>
void find_closest_of(const certificates::Stencil& pair, const PositionOf& position,
                     certificates::Closest<Dim, S>& closest) {
  std::array<Vec<S, Dim>, 4> x;
  for (std::size_t i = 0; i < pair.size(); ++i) x[i] = position(pair.vertices[i]);
  certificates::find_closest<Dim, S>(pair.kind, std::span<const Vec<S, Dim>>(x.data(), pair.size()), closest);
}

/// The same by value.
template <class S, int Dim, class PositionOf>
certificates::Closest<Dim, S> closest_of(const certificates::Stencil& pair, const PositionOf& position) {
  certificates::Closest<Dim, S> closest;
  find_closest_of<S, Dim>(pair, position, closest);
  return closest;
}

/// The approach of a pair whose vertices are at position(vertex).
template <class S, int Dim, class PositionOf>
void find_approach_of(const certificates::Stencil& pair, const PositionOf& position, Approach<S, Dim>& approach) {
  find_closest_of<S, Dim>(pair, position, approach.closest);
  approach.distance = approach.closest.distance();
}

/// The same at the time of an event.
template <class S, int Dim, class Recorder>
void find_approach(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair, Approach<S, Dim>& approach) {
  const auto position = [&now](VertexId i) -> Vec<S, Dim> { return now.particles[i].at(now.t); };
  find_approach_of<S, Dim>(pair, position, approach);
}

}  // namespace noli::integrator
