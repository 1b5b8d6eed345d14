// SPDX-License-Identifier: Apache-2.0
//
// How far `noli` goes, and how it ends where it goes no farther: runs small scenes and verifies pairs of frames from
// the ordinary to the extreme (stability_rows.h), with the `noli` program itself, as a user would.
//
// Promises asked of each point, in this order
//   end        the program ends by itself within its time, with the exit code and verdict that belong together
//   goes on    the run gets to its end: its exit code is 0
//   verified   what was committed is verified again from the files alone: nothing touches
//   finite     energies and momenta of all windows are numbers
//   energy     at the ends of windows it differs from that at the beginning by at most `most_energy_error` of it
//   momentum   where nothing is pinned: linear and angular, about the origin, by at most `most_momentum_error` of
//              theirs at the first window's end
//   resume     a run that was stopped half way and resumed has the same bytes
//   answer     of two frames: what is known of them
// What does not go on may do so for any reason that it names, as long as it does not exit with 0: it fails closed. What
// exits with 0 has to keep all the rest; the energy may go astray where the program says so, with its verdict
// `unstable` and exit code 1. Everything else is a *finding*.
//
// What this does not do: contact found by scenes is not judged a second time (`noli fuzz` does that); energy and
// momentum are looked at at ends of windows only.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "audit/numerics/stability_rows.h"

namespace noli::audit {

constexpr double most_energy_error = 0.05;
constexpr double most_momentum_error = 1e-9;

struct StabilityOptions {
  std::filesystem::path program;                                   ///< the `noli` that is asked
  std::chrono::nanoseconds point_limit{std::chrono::seconds(20)};  ///< of a run; it is ended after twice that and 10 s
  std::filesystem::path out;  ///< folder for the input of findings, made for the first
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double share, const std::string& row)> progress;  ///< may be empty; before each point
};

struct StabilityPoint {
  double value = 0;
  int exit_code = -1;   ///< of `noli simulate` or `noli verify`; -1: it did not exit by itself
  std::string gives;    ///< the first promise that is not kept, and how; empty: all are
  std::string message;  ///< what the program said of it, one line; empty if all are kept
  /// In parts of the energy at the beginning; none of a run that did not get to its end, or began without energy.
  std::optional<double> energy_error;
  std::optional<double> momentum_error;  ///< the larger of both, in parts; none as above, and where forces act
  std::vector<std::string> findings;
  std::filesystem::path saved;  ///< input of the findings; empty if none
  double seconds = 0;           ///< wall clock, all programs together
};

struct StabilityResult {
  std::string name, varied;
  bool contact = false;
  std::vector<StabilityPoint> points;  ///< fewer than values if it was stopped

  /// The first point that keeps not all promises; points.size() if there is none.
  std::size_t first_to_give() const;
};

struct StabilityReport {
  std::vector<StabilityResult> rows;
  bool complete = true;

  std::size_t points() const;
  std::size_t held() const;
  std::size_t findings() const;
};

/// Throws std::runtime_error when the program is not there, std::system_error when the machine does not do what it
/// has to.
StabilityReport audit_stability(const std::vector<StabilityRow>& rows, const StabilityOptions& options);

}  // namespace noli::audit
