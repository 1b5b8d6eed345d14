// SPDX-License-Identifier: Apache-2.0
//
// Summarises what happened in a run, from its files alone.
//
//   const noli::RunSummary run = noli::summary_of_run("run");
//   if (run.gap) std::printf("nearest: %g m\n", run.gap->up_to);
//
// Notation
//   deepest, nearest   the deepest layer of contact that acted, and the layer that acted at the least distance. A layer
//                      samples distances only at its own times
//   gap                how near the pair of `nearest` came in that window, between those times too: decided exactly,
//                      if the run recorded its world lines
//
// Units: SI; each field names its own.
// Errors: as summary_of_run says. Thread safety: any thread; the files are only read.
// It verifies nothing: run_verify in noli/verify.h does.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <noli/run.h>

namespace noli {

/// A layer that acted, and in which window.
struct ActingMoment {
  std::uint64_t window = 1;  ///< from 1
  ActingLayer action;
};

/// The energy terms of one kind of force [J], as in SeriesRow for a window.
struct ForceWork {
  double potential = 0, damping = 0, held = 0;
};

/// Energies are kinetic energy plus all potentials at the ends of windows [J]; kinetic energy takes velocities half way
/// through the kicks. Works are sums over all windows. last - begin = damping_work + restitution_work + held_work +
/// integration, except for the work of scripts that is booked in advance (SeriesRow::held_ahead).
struct EnergySummary {
  double begin = 0;  ///< at time 0
  double first = 0, last = 0, least = 0, greatest = 0;
  double damping_work = 0;  ///< of damping and friction
  double restitution_work = 0, held_work = 0, integration = 0;
  std::array<ForceWork, force_kinds> kinds{};
  std::vector<ContactWork> materials;  ///< of contact
  std::vector<double> scripts;
};

/// above < gap <= up_to with no double in between; or both are 0, which is contact.
struct ExactGap {
  double above = 0, up_to = 0;
  double time = 0;  ///< approximately the first time at which the pair is within up_to

  friend bool operator==(const ExactGap&, const ExactGap&) = default;
};

struct RunSummary {
  std::string title;
  std::uint32_t dimension = 3;
  bool full = true;  ///< world lines were recorded
  bool open_window = false;
  std::uint64_t windows = 0;
  double time = 0;  ///< of the last window's end [s]
  std::uint64_t breakpoints = 0, halvings = 0;
  std::array<std::uint64_t, force_kinds> events{};
  double smallest_step = 0;             ///< of a free vertex [s]; 0: no vertex is free
  std::optional<EnergySummary> energy;  ///< nothing: no windows
  std::optional<ActingMoment> deepest, nearest;
  std::optional<ExactGap> gap;
  std::vector<ActingMoment> worst;  ///< the windows with the deepest layers, deepest first; at most five
};

/// Throws InputError (no run, a damaged one, of an earlier version).
RunSummary summary_of_run(const std::filesystem::path& run);

}  // namespace noli
