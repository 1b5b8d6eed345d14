// SPDX-License-Identifier: Apache-2.0
//
// Damping along the gradients of what a force measures: a measure is unchanged by rigid motions, so its
// damping leaves linear and angular momentum alone, and rigid motion undamped.
//
// Notation
//   s, g_i   a measure and its gradient at vertex i; w_i the inverse mass there
//   rate     ds/dt = sum g_i.v_i
//   a        sum w_i |g_i|^2: an impulse -J g_i on each vertex lowers the rate by J a
//   b        damping * stiffness of the measure
//   J        h b rate / (1 + h b a): the rate falls to rate / (1 + h b a) and keeps its sign, whatever h and b are; it
//            is the implicit Euler step for the rate
//
// Measures take their turn, each on the velocities that the one before has left.
//
// What this does not do: between masses in motion that no impulse moves (scripted ones) and free ones it is a force
// like any other, which may do work on the free ones. It is no smooth function of time: it belongs to the
// force's events.
#pragma once

#include "integrator/force.h"

namespace noli::integrator {

/// Damps the velocities v of a force's vertices at the positions x for an event of step h [s]. Returns the work on the
/// vertices of finite mass, impulse times the mean of the velocities before and after, which is never positive if the
/// others are at rest.
template <class F, class S, int Dim, std::size_t N>
S damp(const F& force, const Stencil<S, Dim, N>& x, Stencil<S, Dim, N>& v, const std::array<S, N>& inverse_mass,
       const S& h) {
  static_assert(N == F::size && Dim == F::dimension);
  const auto gradients = force.measure_gradients(x);
  const auto stiffness = force.stiffness();
  S work(0);
  for (std::size_t j = 0; j < F::measures; ++j) {
    const auto& g = gradients[j];
    S rate(0), free_rate(0), a(0);
    for (std::size_t i = 0; i < N; ++i) {
      const S part = g[i].dot(v[i]);
      rate += part;
      if (inverse_mass[i] != S(0)) free_rate += part;
      a += inverse_mass[i] * g[i].squaredNorm();
    }
    const S hb = h * force.damping * stiffness[j], J = hb * rate / (S(1) + hb * a);
    for (std::size_t i = 0; i < N; ++i) v[i] -= (inverse_mass[i] * J) * g[i];
    work -= J * (free_rate - S(0.5) * J * a);
  }
  return work;
}

}  // namespace noli::integrator
