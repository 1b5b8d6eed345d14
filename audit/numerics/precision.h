// SPDX-License-Identifier: Apache-2.0
//
// Measures the rounding error of a run in double: replays the same scene, with the same events in the same order, in
// MPFR numbers of several precisions (audit/numerics/replay.h).
//
// Notation
//   E         energy at a window's end: kinetic energy of the velocities halfway through the kicks of that time, all
//             potentials, and the work of scripts booked in advance (integrator/energy.h)
//   D_p       (E - E_1) - (W - W_1) of the run with p bits: its spurious gain in energy. W is the work of damping,
//             friction, restitution and scripts; 1 denotes the end of the first window
//   truncation  D_p of the greatest p: the error of the scheme, whose steps are finite
//   rounding    D of double minus truncation
//
// Windows are not verified, so no window is rolled back or ends early. The run in double equals that of `noli simulate`
// as long as the same holds there. Event times are not computed in higher precision, but see TimeTie.
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
  /// The first one must reproduce double bit for bit; energies are measured against the last one.
  /// (Not in braces: g++ 12 then warns about uninitialised memory where this is inlined.)
  std::vector<Arithmetic> arithmetics = std::vector<Arithmetic>(1, hardware_double);
  std::uint64_t windows = 0;  ///< to run
  int threads = 0;            ///< 0: all processors. Results do not depend on it
  const std::atomic<bool>* stop = nullptr;
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::function<void(double)> progress = [](double) {};  ///< share of windows done; not empty
};

/// The difference between double and another precision at a window's end.
struct Drift {
  double time = 0;              ///< [s]
  double position = 0;          ///< the greatest distance between the two positions of a vertex [m]
  VertexId vertex = 0;          ///< the vertex with that distance
  double position_rms = 0;      ///< over the vertices [m]
  double energy = 0;            ///< E of double minus E of the other [J]
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

  /// The share of rounding in both, treated as independent: 0 to 1.
  double share_of_rounding() const;
};

struct PrecisionOutcome {
  std::size_t vertices = 0;
  double extent = 0;  ///< diagonal of the box around all vertices at time 0 [m]
  std::uint64_t windows = 0, windows_total = 0;
  std::uint64_t events = 0;                 ///< of the run in double
  std::uint64_t examined = 0;               ///< pairs for which layers fired there, counted each time
  std::uint64_t impulses = 0;               ///< those of them for which the layer acted
  std::optional<BitDifference> difference;  ///< between the first run and double
  std::vector<PrecisionRun> runs;
  std::vector<EnergyError> energies;  ///< one for each window
  std::optional<TimeTie> tie;         ///< the first one
  std::optional<std::string> ended;   ///< why the run in double ended
  bool complete = false;              ///< all windows were run

  /// The earliest time at which the order of events would differ: at a tie, or where a layer acts in only one of double
  /// and the greatest precision.
  std::optional<double> order_changes() const;
  /// Windows that ended before a layer acted in only one of these two runs. From then on their distance is meaningless:
  /// the replay follows another motion, but sees only the pairs that came near in double.
  std::size_t windows_in_order() const;
};

/// Throws std::invalid_argument if `arithmetics` is empty or has a precision that MpfrNumber does not support.
PrecisionOutcome audit_precision(const integrator::Model<double, 2>& model, const PrecisionRequest& request);
PrecisionOutcome audit_precision(const integrator::Model<double, 3>& model, const PrecisionRequest& request);

}  // namespace noli::audit
