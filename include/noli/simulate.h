// SPDX-License-Identifier: Apache-2.0
//
// Simulates a scene: integrates window after window, verifies each exactly, and commits it to the run only when nothing
// touches in it.
//
//   noli::SimulateRequest request;
//   request.scene = "scenes/swinging_cloth.json";
//   request.run = "run";
//   const noli::SimulateOutcome outcome = noli::run_simulate(request);
//   if (outcome.end == noli::RunEnd::contact) ...     // outcome.contact->first says who, when and how
//
// Notation
//   window k   k = 1, 2, ...: from the end of the one before up to the next multiple of W, the scene's length of a
//              window, or up to the time at which it has as many breakpoints as the scene allows. While a window is
//              integrated, the one before is verified on another thread
//   run        a folder: manifest.json, scene.json, trajectory.blocks, log.jsonl, series.h5
//
// The bytes of trajectory.blocks depend on the scene and the version alone: not on threads, on where a run was
// interrupted, on who looks. A run that was interrupted goes on with `resume`.
//
// Units: SI; each field names its own.
// Errors: as each function says. Thread safety: runs in different folders may be at work at once; a second process or
// thread that writes to the same run is refused. Nothing is printed.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <noli/findings.h>
#include <noli/run.h>
#include <noli/sequence.h>

namespace noli {

namespace integrator {
struct Scene;
struct Explanation;
}  // namespace integrator

struct SimulateRequest {
  std::filesystem::path scene;
  std::filesystem::path run;
  bool brief = false;           ///< the scene's short form
  bool resume = false;          ///< go on with a run that is there
  bool force = false;           ///< replace a run that is there
  bool prove = true;            ///< with record full, write proof.blocks
  std::optional<double> until;  ///< simulated time to stop at [s]; else the scene's duration
  bool past_duration = false;   ///< it may lie beyond the scene's duration
  bool ignore_space = false;    ///< begin though the disk is predicted not to hold the run
  int threads = 0;              ///< 0: all there are
  std::optional<std::chrono::steady_clock::time_point> deadline;
  const std::atomic<bool>* stop = nullptr;  ///< polled; when it becomes true, the run ends at the last committed window
  std::function<int()> stops;               ///< how often one has asked to stop so far; empty: nobody asks twice
  /// Called behind each window that was committed, with its energies, momenta and counts; false ends the run there, as
  /// an interruption does. Empty: nobody asks.
  std::function<bool(const SeriesRow&)> keep_going;
  /// Called with what is done, and the share of it in [0, 1]: "simulate", then "series.h5". Calls do not overlap.
  std::function<void(std::string_view work, double share)> progress;

  /// For `noli simulate` itself. Called once nothing stands against the run any more, before anything is integrated.
  /// The text says how many bytes the run is about to write.
  std::function<void(const integrator::Scene&, const integrator::Explanation&, const std::string& space)> begun;
};

enum class RunEnd {
  done,         ///< all windows are committed
  contact,      ///< something touches in the next one
  too_near,     ///< in the next one a pair needs more layers of contact than the scene allows
  not_finite,   ///< a number of the next one is none
  unstable,     ///< all windows are committed, but steps that are too long have led the energy astray
  interrupted,  ///< by the user
  out_of_time,
  out_of_memory
};

/// As in the JSON and the log.
const char* name(RunEnd end);

/// How a pair that came too near in the first window stood where the scene begins.
struct StartGap {
  double gap = 0;        ///< [m], rounded up
  double thickness = 0;  ///< of the first layer [m]; above the gap
  double last = 0;       ///< thickness of the last layer that the scene allows [m]
};

struct SimulateOutcome {
  RunEnd end = RunEnd::done;
  bool begun = true;  ///< false: it was stopped before, and nothing was written
  std::string title;
  int dimension = 3;
  std::size_t vertices = 0, cells = 0;
  double window_length = 0;
  std::uint64_t windows = 0;                  ///< committed
  std::uint64_t windows_total = 0;            ///< these, and the least number still to come
  bool some_ended_early = false;              ///< so there may be more to come
  std::uint64_t windows_before = 0;           ///< of those committed, by earlier calls (--resume)
  double time = 0;                            ///< of the last commit [s]
  std::uint64_t events = 0, breakpoints = 0;  ///< of this call
  std::optional<StepResult> contact;          ///< of the window that was refused; times are in seconds
  std::optional<ListedContact> first;         ///< its first one
  NotCompared not_compared;
  std::string first_names;  ///< the features of its first one, or of `limit`, by body and number
  std::optional<PairTooNear> limit;
  std::optional<StartGap> start_gap;  ///< of its pair, if that begins within a layer and ends the first window
  std::optional<NotFinite> not_finite;
  double integration = 0;  ///< what finite steps did to the energy, in all committed windows [J]
  std::optional<EnergyAstray> energy_astray;
  std::uint64_t roll_backs = 0;           ///< of windows that were run again
  bool proved = false;                    ///< proof.blocks has a proof of every window
  std::optional<std::string> no_proof;    ///< why it ends before
  std::uint64_t certificate_defects = 0;  ///< of them, such that more layers from the start were enough
  CertificateCounts certificates;
  SeriesEnd series = SeriesEnd::stopped;
  double seconds = 0, simulating_seconds = 0, verifying_seconds = 0;
  PhaseSeconds phases{};  ///< of the thread that integrates and writes
};

/// Runs it. Ends at the last committed window when it is asked to stop or at the time limit: the one that is being
/// integrated or verified then is dropped. A stop before the run begins leaves no folder. A run of which all windows
/// are committed is done, whenever the stop came. After that series.h5 is written still, unless the user asks once more
/// to stop. Throws InputError (scene), Stopped (while the scene, or a run to go on with, is read), UsageError (a run
/// that is there, or is not), WriteError (the disk will not hold the run), std::system_error (disk), std::bad_alloc.
SimulateOutcome run_simulate(const SimulateRequest& request);

}  // namespace noli
