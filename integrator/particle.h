// SPDX-License-Identifier: Apache-2.0
//
// A vertex as a point mass with a clock of its own (Harmon et al. 2009, section 3): between events it moves on a
// straight line, and is brought up to date when an event moves it.
#pragma once

#include <cstddef>

#include "integrator/vector.h"

namespace noli::integrator {

/// In space and double precision, a cache line: forces that fire by themselves come to particles in no order.
template <class S, int Dim>
constexpr std::size_t particle_alignment = sizeof(S) == 8 && Dim == 3 ? 64 : alignof(S);

template <class S, int Dim>
struct alignas(particle_alignment<S, Dim>) Particle {
  Vec<S, Dim> x;     ///< where it was at time t [m]
  double t = 0;      ///< its clock [s]
  Vec<S, Dim> v;     ///< since then [m/s]
  S inverse_mass{};  ///< [1/kg]; 0: pinned or scripted, no force moves it

  /// Where it is at a time that is not before its clock, if no event comes between. Reading changes nothing: what
  /// rounding does to a run does not depend on who looks.
  Vec<S, Dim> at(double time) const { return x + (S(time) - S(t)) * v; }
};

}  // namespace noli::integrator
