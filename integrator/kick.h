// SPDX-License-Identifier: Apache-2.0
//
// A force fires: lines 3 to 9 of Algorithm 1 (Harmon et al. 2009), with what design, "What an event may write", asks:
// a particle's position, clock and velocity change only if the impulse on it is not zero.
//
// Notation
//   h    step of the force; its impulse is -h grad V (a whole kick, or h/2 at the start of a run)
//
// What this does not do: it keeps no clocks.
#pragma once

#include <span>

#include "noli/integrator/books.h"
#include "noli/integrator/damping.h"
#include "noli/integrator/force.h"
#include "noli/integrator/particle.h"

namespace noli::integrator {

/// What a kick needs beside the force.
template <class S, int Dim, class Recorder>
struct Kicked {
  std::span<Particle<S, Dim>> particles;
  Recorder& record;
  double t;  ///< now
};

/// Gives a particle that is at x now another velocity. Room in the recording is the caller's business.
template <class S, int Dim, class Recorder>
void set_velocity(const Kicked<S, Dim, Recorder>& now, VertexId i, const Vec<S, Dim>& x, const Vec<S, Dim>& v) {
  Particle<S, Dim>& p = now.particles[i];
  now.record.put(i, now.t, x, p.t != now.t);
  p.x = x;
  p.t = now.t;
  p.v = v;
}

/// Books a conservative impulse, velocity going from v_before to v_after: work on a particle that is free; of one that
/// is not, what it takes out of the momentum of all others.
template <class S, int Dim>
void book(Account<S, Dim>& account, const S& inverse_mass, const Vec<S, Dim>& x, const Vec<S, Dim>& impulse,
          const Vec<S, Dim>& v_before, const Vec<S, Dim>& v_after) {
  if (inverse_mass != S(0)) {
    account.work += S(0.5) * impulse.dot(v_before + v_after);
  } else {
    account.impulse -= impulse;
    account.angular_impulse -= moment<S, Dim>(x, impulse);
  }
}

/// The velocities that a force leaves its vertices, at the positions x; books what it does.
template <bool Damped, class F, class S, int Dim>
Stencil<S, Dim, F::size> kicked_velocities(std::span<const Particle<S, Dim>> particles, const F& force,
                                           const Stencil<S, Dim, F::size>& x, const S& h, Account<S, Dim>& account) {
  const auto gradient = force.gradient(x);
  std::array<S, F::size> inverse_mass;
  Stencil<S, Dim, F::size> v;
  for (std::size_t i = 0; i < F::size; ++i) {
    const Particle<S, Dim>& p = particles[force.vertices[i]];
    inverse_mass[i] = p.inverse_mass;
    const Vec<S, Dim> impulse = -h * gradient[i];
    v[i] = p.v + p.inverse_mass * impulse;
    book(account, p.inverse_mass, x[i], impulse, p.v, v[i]);
  }
  if constexpr (Damped) account.damping_work += damp(force, x, v, inverse_mass, h);
  return v;
}

/// Fires one force by itself.
template <bool Damped, class F, class S, int Dim, class Recorder>
void kick(const Kicked<S, Dim, Recorder>& now, const F& force, const S& h, Account<S, Dim>& account) {
  Stencil<S, Dim, F::size> x;
  for (std::size_t i = 0; i < F::size; ++i) x[i] = now.particles[force.vertices[i]].at(now.t);
  const auto v = kicked_velocities<Damped, F, S, Dim>(now.particles, force, x, h, account);
  for (std::size_t i = 0; i < F::size; ++i) {
    if (v[i] != now.particles[force.vertices[i]].v) set_velocity(now, force.vertices[i], x[i], v[i]);
  }
}

/// Where a vertex is at the time of an event of many forces, and whether one of them has changed its velocity.
template <class S, int Dim>
struct Here {
  Vec<S, Dim> x;
  bool changed;
};

/// Fires forces of equal step that strike at one time. `vertices`: all of theirs, each once; `here` has room for every
/// particle. The same numbers as one by one, but that all positions are read first: then no force has to wait for the
/// velocities that the one before it leaves, because positions do not depend on them.
template <bool Damped, class F, class S, int Dim, class Recorder>
void kick_all(const Kicked<S, Dim, Recorder>& now, std::span<const F> forces, std::span<const VertexId> vertices,
              std::span<Here<S, Dim>> here, const S& h, Account<S, Dim>& account) {
  for (const VertexId i : vertices) here[i] = {now.particles[i].at(now.t), false};
  Stencil<S, Dim, F::size> x;
  for (const F& force : forces) {
    for (std::size_t i = 0; i < F::size; ++i) x[i] = here[force.vertices[i]].x;
    const auto v = kicked_velocities<Damped, F, S, Dim>(now.particles, force, x, h, account);
    for (std::size_t i = 0; i < F::size; ++i) {
      Particle<S, Dim>& p = now.particles[force.vertices[i]];
      here[force.vertices[i]].changed |= v[i] != p.v;
      p.v = v[i];
    }
  }
  for (const VertexId i : vertices) {
    if (here[i].changed) set_velocity(now, i, here[i].x, Vec<S, Dim>(now.particles[i].v));
  }
}

}  // namespace noli::integrator
