// SPDX-License-Identifier: Apache-2.0
//
// What happened in a run, from its files alone.
//
// Notation
//   deepest, nearest   the deepest layer of contact that acted, and the least distance that one which acted has seen. A
//                      layer sees its pairs at its own times only
//   gap                how near the pair of `nearest` came in that window, between those times too: decided exactly
//                      (exact_gap.h), if the run recorded its world lines
//   bound              what certificates say of all pairs: none was nearer than eta(L + 1), L the deepest layer that
//                      was ever active
//   part               from the run's begin or a resumption to its end, if it came to one: a part that was killed has
//                      none, and what it would have said of clocks and certificates is lost
//
// What this does not do: it verifies nothing (`noli verify RUN` does).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series.h"
#include "certify/simulate/exact_gap.h"
#include "certify/simulate/phase_clock.h"

namespace noli {

/// A layer that acted, and in which window.
struct ActingMoment {
  std::uint64_t window = 1;  ///< from 1
  ActingLayer action;
};

/// Kinetic energy, of velocities half way through the kicks, and all potentials, at the ends of windows [J].
struct EnergySummary {
  double first = 0, last = 0, least = 0, greatest = 0;
  double damping_work = 0;  ///< of all windows but the first
};

struct RunExplanation {
  std::string title;
  std::uint32_t dimension = 3;
  bool full = true;  ///< world lines were recorded
  bool open_window = false;
  std::uint64_t windows = 0;
  double time = 0;  ///< of the last window's end [s]
  std::uint64_t breakpoints = 0, halvings = 0;
  std::array<std::uint64_t, integrator::force_kinds> events{};
  double smallest_step = 0;             ///< of a free vertex [s]; 0: there is none
  std::optional<EnergySummary> energy;  ///< nothing: no windows
  std::optional<ActingMoment> deepest, nearest;
  std::optional<ExactGap> gap;
  std::vector<ActingMoment> worst;  ///< the windows with the deepest layers, deepest first; at most five
  LogFacts log;

  /// Of these materials, the least eta(L + 1) [m]; nothing without contact, or when the log does not tell it all.
  std::optional<double> bound() const;
};

/// Throws InputError (no run, a damaged one, of an earlier version).
RunExplanation explain_run(const std::filesystem::path& run);

}  // namespace noli
