// SPDX-License-Identifier: Apache-2.0
//
// Finds the limits of `noli`, and how it ends beyond them. Runs small scenes and verifies pairs of frames from the
// ordinary to the extreme (stability_rows.h), with the `noli` program itself, as a user would.
//
// Promises tested at each point, in this order
//   end        the program ends by itself within its time, with an exit code that matches its verdict
//   goes on    the run reaches its end: its exit code is 0
//   verified   the committed windows verify again from the files alone: nothing touches
//   finite     energies and momenta of all windows are finite
//   energy     at the ends of windows it differs from the initial energy by at most `most_energy_error` of it
//   momentum   if nothing is pinned: linear and angular, about the origin, differ by at most `most_momentum_error` of
//              their values at the first window's end
//   resume     a run that was stopped halfway and resumed has the same bytes
//   answer     for two frames: the known answer
// A run that does not go on may give any reason, as long as it does not exit with 0: it fails closed. A run that exits
// with 0 must keep all other promises. Energy may drift only if the program says so, with the verdict `unstable` and
// exit code 1. Everything else is a *finding*.
//
// Contact found by scenes is not judged a second time (`noli fuzz` does that). Energy and momentum are only compared at
// the ends of windows.
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
  std::filesystem::path program;                                   ///< the `noli` to test
  std::chrono::nanoseconds point_limit{std::chrono::seconds(20)};  ///< per run; killed after twice that plus 10 s
  std::filesystem::path out;  ///< folder for the input of findings; created for the first one
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double share, const std::string& row)> progress;  ///< may be empty; before each point
};

struct StabilityPoint {
  double value = 0;
  int exit_code = -1;   ///< of `noli simulate` or `noli verify`; -1: it did not exit by itself
  std::string gives;    ///< the first promise that was broken, and how; empty if all were kept
  std::string message;  ///< what the program said about it, one line; empty if all were kept
  /// Relative to the initial energy; unset for a run that did not reach its end or began without energy.
  std::optional<double> energy_error;
  std::optional<double> momentum_error;  ///< the larger of both, relative; unset as above, or if anything is pinned
  std::vector<std::string> findings;
  std::filesystem::path saved;  ///< input of the findings; empty without findings
  double seconds = 0;           ///< wall clock, all programs together
};

struct StabilityResult {
  std::string name, varied;
  bool contact = false;
  std::vector<StabilityPoint> points;  ///< fewer than `values` if it was stopped

  /// The first point that breaks a promise; points.size() if none does.
  std::size_t first_to_give() const;
};

struct StabilityReport {
  std::vector<StabilityResult> rows;
  bool complete = true;

  std::size_t points() const;
  std::size_t held() const;
  std::size_t findings() const;
};

/// Throws std::runtime_error if the program does not exist, std::system_error if a system call fails.
StabilityReport audit_stability(const std::vector<StabilityRow>& rows, const StabilityOptions& options);

/// A figure with a line of boxes for each row, from the ordinary to the extreme. Each box has its value, and the energy
/// error if there is one. Green: holds; yellow: fails closed, with the reason; red: a finding.
std::string stability_svg(const StabilityReport& report);

}  // namespace noli::audit
