// SPDX-License-Identifier: Apache-2.0
//
// Finds resonance between steps: two forces, each stable by itself, may be unstable together if one kicks in time with
// the other's oscillation (Fong, Darve, Lew, "Stability of asynchronous variational integrators", study this; the
// formulas here are derived).
//
// Notation, for a unit mass on two springs
//   h1, omega1   step of the slow spring, and the frequency that this spring alone would give the mass; h1 > h2
//   h2, omega2   of the fast spring; h2 omega2 < 2
//   theta        phase of the fast spring in one of its steps: sin(theta/2) = h2 omega2 / 2, near h2 omega2 if well
//                resolved
//   phi          its phase in a slow step, theta h1/h2
//   kappa        strength of a slow kick, omega1^2 h1 h2 / sin(theta), near omega1^2 h1 / omega2 if well resolved
// The map over h1 has the trace 2 cos(phi) - kappa sin(phi). The motion is unstable if its magnitude is above 2, that
// is for phi in (n pi - 2 atan(kappa/2), n pi), n = 1, 2, ... This is exact if h1 is a multiple of h2. For other
// fractions p/q of small numbers the map over q h1 = p h2 is multiplied out; for all others the formula is an
// approximation.
//
// A mesh has many frequencies, and each pair here is only one of them; damping, which suppresses weak resonances, is
// ignored. Use it for warnings only: the bits of these numbers may differ between machines.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace noli::integrator {

/// Forces of one step, and a frequency of the vertices if only these forces acted.
struct Oscillation {
  double step = 0;   ///< [s], positive
  double omega = 0;  ///< [1/s], positive
};

/// The trace of the map of position and velocity over slow_steps h1 = fast_steps h2, by multiplying out all kicks. Its
/// determinant is 1, so it is unstable if the magnitude of the trace is above 2.
inline double monodromy_trace(const Oscillation& slow, const Oscillation& fast, int slow_steps, int fast_steps) {
  const double unit = slow.step / fast_steps;  // both steps are multiples of it
  double trace = 0;
  for (const int column : {0, 1}) {
    double x = column == 0 ? 1 : 0, v = column == 0 ? 0 : 1;
    int last = 0;
    for (int now = 1; now <= slow_steps * fast_steps; ++now) {
      const bool kick_slow = now % fast_steps == 0, kick_fast = now % slow_steps == 0;
      if (!kick_slow && !kick_fast) continue;
      x += (now - last) * unit * v;
      last = now;
      v -= ((kick_slow ? slow.step * slow.omega * slow.omega : 0) +
            (kick_fast ? fast.step * fast.omega * fast.omega : 0)) *
           x;
    }
    trace += column == 0 ? x : v;
  }
  return trace;
}

/// How slow kicks meet the fast oscillation.
struct Meeting {
  double phase = 0;     ///< phi
  double strength = 0;  ///< kappa
};

/// Precondition: h2 omega2 < 2.
inline Meeting meeting(const Oscillation& slow, const Oscillation& fast) {
  const double theta = 2 * std::asin(fast.step * fast.omega / 2);
  return {theta * slow.step / fast.step, slow.omega * slow.omega * slow.step * fast.step / std::sin(theta)};
}

/// phi in (n pi - 2 atan(kappa/2), n pi) for some n >= 1.
inline bool in_tongue(const Meeting& meeting) {
  const double half_turns = meeting.phase / std::numbers::pi;
  return (std::ceil(half_turns) - half_turns) * std::numbers::pi < 2 * std::atan(meeting.strength / 2) &&
         half_turns != std::ceil(half_turns);
}

/// p, q with p h2 = q h1 up to rounding and q at most 5: (fast steps, slow steps); (0, 0) if there are none.
inline std::pair<int, int> common_period(const Oscillation& slow, const Oscillation& fast) {
  const double ratio = slow.step / fast.step;
  for (int q = 1; q <= 5; ++q) {
    const double p = std::round(ratio * q);
    if (std::abs(ratio * q - p) <= 1e-9 * p && p < 1e6) return {static_cast<int>(p), q};
  }
  return {0, 0};
}

/// Whether the two springs together are unstable. Preconditions: h1 >= h2, h2 omega2 < 2.
inline bool resonant(const Oscillation& slow, const Oscillation& fast) {
  const auto [fast_steps, slow_steps] = common_period(slow, fast);
  if (slow_steps <= 1) return in_tongue(meeting(slow, fast));
  return std::abs(monodromy_trace(slow, fast, slow_steps, fast_steps)) > 2;
}

/// How slow kicks meet the fast oscillation, if the two together are unstable. Nothing if the first step is not the
/// longer one, or for oscillations at or beyond their own limit (step * omega >= 2), which have a warning of their own.
inline std::optional<Meeting> resonance(const Oscillation& slow, const Oscillation& fast) {
  if (!(slow.step > fast.step) || fast.step * fast.omega >= 2 || slow.step * slow.omega >= 2) return std::nullopt;
  if (!resonant(slow, fast)) return std::nullopt;
  return meeting(slow, fast);
}

}  // namespace noli::integrator
