// SPDX-License-Identifier: Apache-2.0
//
// How far double precision carries a run: the same scene, the same events in the same order, in MPFR numbers of several
// precisions (audit/numerics/replay.h).
//
// Notation
//   E         energy at a window's end: kinetic energy of the velocities half way through the kicks of that time, and
//             all potentials, and what scripts have been booked in advance (integrator/energy.h)
//   D_p       (E - E_1) - (W - W_1) of the run with p bits, W the work of damping, friction, restitution and scripts,
//             1 the end of the first window: by how much the run has gained energy that nothing gave it
//   truncation  D_p of the greatest p: what is left is the error of the scheme, its steps being finite
//   rounding    D of double less that
//
// What this does not do: windows are not verified, so none is rolled back, and none ends early; the run in double is
// that of noli simulate as long as that does neither. Event times are not computed in higher precision, but see
// TimeTie.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "audit/numerics/divergence.h"
#include "audit/numerics/mpfr_number.h"
#include "audit/numerics/time_order.h"
#include "integrator/model.h"

namespace noli::audit {

struct PrecisionRequest {
  /// The first one is to yield the bits of double; the last one is what energies are measured against.
  /// (Not in braces, which g++ 12 takes for uninitialised where this is inlined.)
  std::vector<Arithmetic> arithmetics = std::vector<Arithmetic>(1, hardware_double);
  std::uint64_t windows = 0;  ///< to be run
  int threads = 0;            ///< 0: all there are. They change nothing but the time it takes
  const std::atomic<bool>* stop = nullptr;
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::function<void(double)> progress = [](double) {};  ///< share of the windows; not empty
};

/// Double against another precision, at a window's end.
struct Drift {
  double time = 0;              ///< [s]
  double position = 0;          ///< the greatest distance between the two places of one vertex [m]
  VertexId vertex = 0;          ///< the one that is so far off
  double position_rms = 0;      ///< over the vertices [m]
  double energy = 0;            ///< E of double less that of the other [J]
  double momentum = 0;          ///< length of the difference [N s]
  double angular_momentum = 0;  ///< [N m s]
};

struct PrecisionRun {
  Arithmetic arithmetic;
  std::vector<Drift> drifts;  ///< one for each window
  CourseChanges changes;
  std::optional<std::string> ended;  ///< why it ended before the run in double, if it did
};

/// At a window's end [J].
struct EnergyError {
  double time = 0;        ///< [s]
  double energy = 0;      ///< E of double
  double truncation = 0;  ///< D of the greatest precision
  double rounding = 0;

  /// Of both, as if they were independent: 0 to 1.
  double share_of_rounding() const;
};

struct PrecisionOutcome {
  std::size_t vertices = 0;
  double extent = 0;  ///< diagonal of the box around all vertices at time 0 [m]
  std::uint64_t windows = 0, windows_total = 0;
  std::uint64_t events = 0;                 ///< of the run in double
  std::uint64_t examined = 0;               ///< pairs for which layers fired there, each time counted
  std::uint64_t impulses = 0;               ///< of these, layers that acted
  std::optional<BitDifference> difference;  ///< of the first run from double
  std::vector<PrecisionRun> runs;
  std::vector<EnergyError> energies;  ///< one for each window
  std::optional<TimeTie> tie;         ///< the first
  std::optional<std::string> ended;   ///< why the run in double did
  bool complete = false;              ///< all windows were run

  /// The earliest time at which the order of events would be another: a layer that acts in double and not in the
  /// greatest precision, or the other way round, or a tie.
  std::optional<double> order_changes() const;
  /// Windows that ended before a layer acted in one of these two runs only. From then on a replay is another
  /// experiment: it sees no pairs but those that the run in double came near, so how far apart they are says nothing.
  std::size_t windows_in_order() const;
};

/// Throws std::invalid_argument where there is no arithmetic or it has no such precision.
PrecisionOutcome audit_precision(const integrator::Model<double, 2>& model, const PrecisionRequest& request);
PrecisionOutcome audit_precision(const integrator::Model<double, 3>& model, const PrecisionRequest& request);

}  // namespace noli::audit
