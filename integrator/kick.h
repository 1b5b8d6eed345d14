// SPDX-License-Identifier: Apache-2.0
//
// Fires forces: lines 3 to 9 of Algorithm 1 (Harmon et al. 2009), with the rule of design, "What an event may write": a
// particle's position, clock and velocity change only if the impulse on it is not zero.
//
// Notation
//   h      step of a force; its impulses are J = -h grad V (a whole kick, or h/2 at the start of a run)
//   blows  forces that fire, in order, and their effect: forces of one step at one time (GroupBlows), or of any times
//          but without a vertex in common (SingleBlows)
// In both cases no force's positions depend on the velocities that another one leaves. So the impulses of a row of
// forces are computed first, then applied. Two short loops keep more forces in flight in the processor: one loop took
// half as long again. The numbers are those of firing one after the other.
//
// Damping acts along the gradients of a force's measures. Rigid motions do not change a measure, so its damping does
// not change linear and angular momentum, and rigid motion is undamped.
//   s, g_i   a measure and its gradient at vertex i; w_i the inverse mass there
//   rate     ds/dt = sum g_i.v_i
//   a        sum w_i |g_i|^2: an impulse -J g_i on each vertex lowers the rate by J a
//   b        damping * stiffness of the measure
//   J        h b rate / (1 + h b a): the rate falls to rate / (1 + h b a) and keeps its sign, whatever h and b are; it
//            is the implicit Euler step for the rate
// Measures are damped in turn, each with the velocities that the previous one has left. Between moving masses that no
// impulse moves (scripted ones) and free ones, damping is a force like any other, which may do work on the free ones.
// It is not a smooth function of time: it belongs to the force's events.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "integrator/books.h"
#include "integrator/force.h"
#include "integrator/instant.h"
#include "integrator/phase.h"

namespace noli::integrator {

/// A cache line in space and double precision, as forces with clocks of their own access particles in random order.
template <class S, int Dim>
constexpr std::size_t particle_alignment = sizeof(S) == 8 && Dim == 3 ? 64 : alignof(S);

/// A vertex as a point mass with a clock of its own. Between events it moves on a straight line; it is updated when an
/// event moves it.
template <class S, int Dim>
struct alignas(particle_alignment<S, Dim>) Particle {
  Vec<S, Dim> x;     ///< position at time t [m]
  double t = 0;      ///< its clock [s]
  Vec<S, Dim> v;     ///< since then [m/s]
  S inverse_mass{};  ///< [1/kg]; 0: pinned or scripted, no force moves it

  /// Its position at a time not before its clock, if no event comes in between. Reading changes nothing, so rounding in
  /// a run does not depend on readers.
  Vec<S, Dim> at(double time) const { return x + (S(time) - S(t)) * v; }

  bool finite() const { return x.allFinite() && v.allFinite(); }
};

/// Damps the velocities v of a force's vertices at the positions x for an event of step h [s]. Returns the impulse on
/// each; its work with the mean of the velocities before and after is never positive.
template <class F, class S, int Dim, std::size_t N>
VertexVectors<S, Dim, N> damp(const F& force, const VertexVectors<S, Dim, N>& x, VertexVectors<S, Dim, N>& v,
                              const std::array<S, N>& inverse_mass, const S& h) {
  static_assert(N == F::size && Dim == F::dimension);
  const auto gradients = force.measure_gradients(x);
  const auto stiffness = force.stiffness();
  VertexVectors<S, Dim, N> impulses;
  for (auto& impulse : impulses) impulse.setZero();
  for (std::size_t j = 0; j < F::measures; ++j) {
    const auto& g = gradients[j];
    S rate(0), a(0);
    for (std::size_t i = 0; i < N; ++i) {
      rate += g[i].dot(v[i]);
      a += inverse_mass[i] * g[i].squaredNorm();
    }
    const S hb = h * force.damping * stiffness[j], J = hb * rate / (S(1) + hb * a);
    for (std::size_t i = 0; i < N; ++i) {
      v[i] -= (inverse_mass[i] * J) * g[i];
      impulses[i] -= J * g[i];
    }
  }
  return impulses;
}

/// The arguments of a kick besides the force.
template <class S, int Dim, class Recorder>
struct Kicked {
  std::span<Particle<S, Dim>> particles;
  Recorder& record;
  double t;                     ///< now
  ScriptBook<S, Dim>* scripts;  ///< books the work of scripts
};

/// Gives a particle that is at x now another velocity. Precondition: the recording has room.
template <class S, int Dim, class Recorder>
void set_velocity(const Kicked<S, Dim, Recorder>& now, VertexId i, const Vec<S, Dim>& x, const Vec<S, Dim>& v) {
  Particle<S, Dim>& p = now.particles[i];
  now.record.put(i, now.t, x, p.t != now.t);
  p.x = x;
  p.t = now.t;
  p.v = v;
}

/// Whether any coordinate differs; usually the first one does.
template <class S, int Dim>
bool differ(const Vec<S, Dim>& a, const Vec<S, Dim>& b) {
  for (int k = 0; k < Dim; ++k) {
    if (a[k] != b[k]) return true;
  }
  return false;
}

/// The state of a vertex at the time of an event of many forces, and whether one of them has changed its velocity. It
/// has a copy of the mass, which could not be read without a stall next to a velocity that has just been written.
template <class S, int Dim>
struct alignas(particle_alignment<S, Dim>) Here {
  Vec<S, Dim> x;
  S inverse_mass;
  Vec<S, Dim> damping;  ///< impulses of damping so far [N s]
  bool changed;
};

/// Forces of equal step that strike at one time. Precondition: `here` has been filled for all their vertices.
template <class F, class S, int Dim, class Recorder>
struct GroupBlows {
  static constexpr bool are_events = false;  ///< their works are booked elsewhere (integrator/instant.h)
  std::span<const F> forces;
  S h;
  Kicked<S, Dim, Recorder> now;
  std::span<Here<S, Dim>> here;

  std::size_t size() const { return forces.size(); }
  const F& force(std::size_t k) const { return forces[k]; }
  S step(std::size_t) const { return h; }
  const Vec<S, Dim>& velocity(VertexId v) const { return now.particles[v].v; }
  const S& inverse_mass(VertexId v) const { return here[v].inverse_mass; }
  Vec<S, Dim> position(std::size_t, VertexId v) const { return here[v].x; }
  double time(std::size_t) const { return now.t; }
  ScriptBook<S, Dim>& scripts() const { return *now.scripts; }
  void settle(std::size_t, VertexId i, const Vec<S, Dim>& v) const {
    if (differ<S, Dim>(v, now.particles[i].v)) here[i].changed = true;
    now.particles[i].v = v;
  }
};

/// A force with a clock of its own that fires.
struct DueForce {
  double t, h;
  std::size_t force;
  std::uint16_t carries = 0;  ///< bit k: gravity acts on vertex k with it
  double next = 0;            ///< when it is due again
};

/// Forces without a vertex in common.
template <class F, class S, int Dim, class Recorder>
struct SingleBlows {
  static constexpr bool are_events = true;
  std::span<const F> forces;  ///< some of them fire
  std::span<const DueForce> firing;
  std::span<Particle<S, Dim>> particles;
  Recorder& record;
  ScriptBook<S, Dim>* script_book;

  std::size_t size() const { return firing.size(); }
  const F& force(std::size_t k) const { return forces[firing[k].force]; }
  S step(std::size_t k) const { return S(firing[k].h); }
  const Vec<S, Dim>& velocity(VertexId v) const { return particles[v].v; }
  const S& inverse_mass(VertexId v) const { return particles[v].inverse_mass; }
  Vec<S, Dim> position(std::size_t k, VertexId v) const { return particles[v].at(firing[k].t); }
  double time(std::size_t k) const { return firing[k].t; }
  ScriptBook<S, Dim>& scripts() const { return *script_book; }
  void settle(std::size_t k, VertexId i, const Vec<S, Dim>& v) const {
    if (!differ<S, Dim>(v, particles[i].v)) return;
    set_velocity(Kicked<S, Dim, Recorder>{particles, record, firing[k].t, script_book}, i, position(k, i), v);
  }
};

/// A held particle when an event strikes it.
template <class S, int Dim>
struct Held {
  VertexId vertex;
  double t;       ///< of the event [s]
  Vec<S, Dim> x;  ///< its position then
  Vec<S, Dim> v;  ///< its velocity from then on
};

/// Books the momentum that a held particle takes from all others, and the work of its holder. `impulse`: the total of
/// the event. Returns the velocity with which it works.
template <class S, int Dim>
[[gnu::noinline]] Vec<S, Dim> book_held(Account<S, Dim>& account, ScriptBook<S, Dim>& scripts, const Held<S, Dim>& held,
                                        const Vec<S, Dim>& impulse) {
  account.impulse -= impulse;
  account.angular_impulse -= moment<S, Dim>(held.x, impulse);
  const Vec<S, Dim> v = scripts.velocity(held.vertex, held.t, held.v);
  const S work = -impulse.dot(v);
  account.held_work += work;
  scripts.add(held.vertex, work);
  return v;
}

/// The impulses of blow k. Written in place, number by number: copying numbers that were just written in smaller pieces
/// stalls the processor.
template <class F, class S, int Dim, class Blows>
void find_impulses(const Blows& blows, std::size_t k, VertexVectors<S, Dim, F::size>& impulses) {
  const F& force = blows.force(k);
  VertexVectors<S, Dim, F::size> x;
  for (std::size_t i = 0; i < F::size; ++i) x[i] = blows.position(k, force.vertices[i]);
  const VertexVectors<S, Dim, F::size> gradient = force.gradient(x);
  const S minus_h = -blows.step(k);
  for (std::size_t i = 0; i < F::size; ++i) {
    for (int d = 0; d < Dim; ++d) impulses[i][d] = minus_h * gradient[i][d];
  }
}

/// The effect of a blow on its vertices, before it is applied.
template <class S, int Dim, std::size_t N>
struct BlowOf {
  VertexVectors<S, Dim, N> impulses;  ///< of the potential
  VertexVectors<S, Dim, N> damping;   ///< of damping; uninitialised if nothing is damped
  VertexVectors<S, Dim, N> v;         ///< velocities after it [m/s]
};

/// Books blow k as an event; if it is only part of an event, books only held particles.
template <bool Damped, class S, int Dim, std::size_t N, class Blows>
void book(const Blows& blows, std::size_t k, const BlowOf<S, Dim, N>& blow, Account<S, Dim>& account) {
  const auto& vertices = blows.force(k).vertices;
  S twice_work(0), twice_damping(0);
  for (std::size_t i = 0; i < N; ++i) {
    const bool is_held = blows.inverse_mass(vertices[i]) == S(0);
    if (!Blows::are_events && !is_held) continue;
    Vec<S, Dim> twice_mean = blows.velocity(vertices[i]) + blow.v[i];
    if (is_held) [[unlikely]] {
      Vec<S, Dim> whole = blow.impulses[i];
      if constexpr (Damped) whole += blow.damping[i];
      const Held<S, Dim> held{vertices[i], blows.time(k), blows.position(k, vertices[i]), blow.v[i]};
      twice_mean = S(2) * book_held<S, Dim>(account, blows.scripts(), held, whole);
    }
    twice_work += blow.impulses[i].dot(twice_mean);
    if constexpr (Damped) twice_damping += blow.damping[i].dot(twice_mean);
  }
  account.work += S(0.5) * twice_work;
  if constexpr (Damped) account.damping_work += S(0.5) * twice_damping;
}

/// Gives the vertices of blow k their velocities, and books that.
template <bool Damped, class S, int Dim, std::size_t N, class Blows>
void apply(const Blows& blows, std::size_t k, const VertexVectors<S, Dim, N>& impulses, Account<S, Dim>& account) {
  const auto& force = blows.force(k);
  BlowOf<S, Dim, N> blow;
  blow.impulses = impulses;
  for (std::size_t i = 0; i < N; ++i) {
    blow.v[i] = blows.velocity(force.vertices[i]) + blows.inverse_mass(force.vertices[i]) * impulses[i];
  }
  if constexpr (Damped) {
    VertexVectors<S, Dim, N> x;
    std::array<S, N> inverse_mass;
    for (std::size_t i = 0; i < N; ++i) {
      x[i] = blows.position(k, force.vertices[i]);
      inverse_mass[i] = blows.inverse_mass(force.vertices[i]);
    }
    blow.damping = damp(force, x, blow.v, inverse_mass, blows.step(k));
    if constexpr (!Blows::are_events) {
      for (std::size_t i = 0; i < N; ++i) blows.here[force.vertices[i]].damping += blow.damping[i];
    }
  }
  book<Damped>(blows, k, blow, account);
  for (std::size_t i = 0; i < N; ++i) blows.settle(k, force.vertices[i], blow.v[i]);
}

/// Fires all blows. Leaves `activity` at its last phase.
template <bool Damped, class F, class S, int Dim, class Blows>
void strike(const Blows& blows, Account<S, Dim>& account, Activity& activity) {
  constexpr std::size_t row = 64;
  std::array<VertexVectors<S, Dim, F::size>, row> impulses;
  for (std::size_t begin = 0; begin < blows.size(); begin += row) {
    const std::size_t end = std::min(blows.size(), begin + row);
    activity.set(Phase::force);
    for (std::size_t k = begin; k < end; ++k) find_impulses<F, S, Dim>(blows, k, impulses[k - begin]);
    activity.set(Phase::kick);
    for (std::size_t k = begin; k < end; ++k) apply<Damped>(blows, k, impulses[k - begin], account);
  }
  account.events += blows.size();
}

/// Fires forces of equal step that strike at one time. `vertices`: of these forces, each once; `here` has room for
/// every particle; `last`: no other forces strike at this time after them.
template <bool Damped, class F, class S, int Dim, class Recorder>
void kick_all(const Kicked<S, Dim, Recorder>& now, std::span<const F> forces, std::span<const VertexId> vertices,
              std::span<Here<S, Dim>> here, const S& h, bool last, Instant<S, Dim>& instant, Account<S, Dim>& account,
              Activity& activity) {
  activity.set(Phase::force);
  instant.template begin<Damped>(F::kind, last, vertices, [&](VertexId i) -> const Vec<S, Dim>& {
    const Particle<S, Dim>& p = now.particles[i];
    here[i] = {p.at(now.t), p.inverse_mass, Vec<S, Dim>::Zero(), false};
    return p.v;
  });
  const GroupBlows<F, S, Dim, Recorder> blows{forces, h, now, here};
  strike<Damped, F, S, Dim>(blows, account, activity);
  const auto settled = [&](VertexId i) -> const Particle<S, Dim>& {
    if (here[i].changed) set_velocity(now, i, here[i].x, Vec<S, Dim>(now.particles[i].v));
    return now.particles[i];
  };
  instant.template end<Damped>(settled, [&](VertexId i) -> const Vec<S, Dim>& { return here[i].damping; });
}

}  // namespace noli::integrator
