// SPDX-License-Identifier: Apache-2.0
//
// Simulates a scene: integrates window after window, verifies each exactly, and commits it to the run only if nothing
// touches in it. Reproduces windows of a run.
//
//   noli::SimulateRequest request;
//   request.scene = "scenes/swinging_cloth.json";
//   request.run = "run";
//   const noli::SimulateOutcome outcome = noli::run_simulate(request);
//   if (outcome.end == noli::RunEnd::contact) ...     // outcome.contact->first says who, when and how
//
// Notation
//   window k   k = 1, 2, ...: from the end of window k - 1 to the next multiple of W, the scene's length of a window.
//              It ends earlier if it has as many breakpoints as the scene allows. With two threads or more, it is
//              integrated while the previous one is verified
//   run        a folder: manifest.json, scene.json, trajectory.blocks, log.jsonl, series.h5 and, with record full,
//              proof.blocks
//
// The bytes of trajectory.blocks depend only on the scene, its form, how far it runs and the version: not on threads,
// interruptions or readers. An interrupted run goes on with `resume`, and run_reproduce makes the bytes of one window
// again. For all windows, and to verify them again, use run_verify in noli/verify.h with `reproduce`.
//
// Units: SI; each field names its own.
// Errors: as each function says. Thread safety: simulations may run at once in different folders; a second writer to
// the same run is refused. Runs may be reproduced at once, also the same one. Nothing is printed.
#pragma once

#include <array>
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

/// What a user should know before a run.
struct SimulateStart {
  bool has_short_form = false;     ///< of the scene: without it, `brief` changes nothing
  std::vector<std::string> notes;  ///< of the scene, a line each: warnings, then resonances
  std::string space;               ///< how many bytes the run is about to write
};

struct SimulateRequest {
  std::filesystem::path scene;
  std::filesystem::path run;
  bool brief = false;           ///< the scene's short form
  bool resume = false;          ///< go on with an existing run
  bool force = false;           ///< replace an existing run
  bool prove = true;            ///< with record full, write proof.blocks
  std::optional<double> until;  ///< simulated time to stop at [s]; else the scene's duration
  bool past_duration = false;   ///< `until` may lie beyond the scene's duration
  bool ignore_space = false;    ///< begin even if the disk is predicted to be too small for the run
  int threads = 0;              ///< 0: all there are
  std::optional<std::chrono::steady_clock::time_point> deadline;
  const std::atomic<bool>* stop = nullptr;  ///< polled; when it becomes true, the run ends at the last committed window
  std::function<int()> stops;               ///< the number of requests to stop so far; empty: never more than one
  /// Called after each committed window, with its energies, momenta and counts; false ends the run there, like an
  /// interruption. May be empty.
  std::function<bool(const SeriesRow&)> keep_going;
  /// Called with what is done, and the share of it in [0, 1]: "simulate", then "series.h5". Calls do not overlap.
  std::function<void(std::string_view work, double share)> progress;
  /// Called once all checks have passed, before anything is integrated.
  std::function<void(const SimulateStart& start)> begins;
};

enum class RunEnd {
  done,         ///< all windows are committed
  contact,      ///< something touches in the next window
  too_near,     ///< in the next window a pair needs more layers of contact than the scene allows
  not_finite,   ///< the next window produced a NaN or an infinity
  unstable,     ///< all windows are committed, but the energy drifted because steps are too long
  interrupted,  ///< by the user
  out_of_time,
  out_of_memory
};

/// The name used in the JSON and the log.
const char* name(RunEnd end);

/// How near a pair that came too near in the first window was when the scene began.
struct StartGap {
  double gap = 0;        ///< [m], rounded up
  double thickness = 0;  ///< of the first layer [m]; above the gap
  double last = 0;       ///< thickness of the last layer that the scene allows [m]
};

struct SimulateOutcome {
  RunEnd end = RunEnd::done;
  bool begun = true;  ///< false: it was stopped before it began, and nothing was written
  std::string title;
  int dimension = 3;
  std::size_t vertices = 0, cells = 0;
  bool allow_unstable = false;  ///< the scene accepts steps above the limit of stability
  double window_length = 0;
  std::uint64_t windows = 0;                  ///< committed
  std::uint64_t windows_total = 0;            ///< these, and the least number still to come
  bool some_ended_early = false;              ///< some windows ended before a multiple of W, so more may follow
  std::uint64_t windows_before = 0;           ///< of those committed, by earlier calls (--resume)
  double time = 0;                            ///< of the last commit [s]
  std::uint64_t events = 0, breakpoints = 0;  ///< of this call
  std::optional<StepResult> contact;          ///< of the window that was refused; times are in seconds
  std::optional<ListedContact> first;         ///< the first contact in it
  NotCompared not_compared;
  std::string first_names;  ///< the features of `first`, or of `limit`, by body and number
  std::optional<PairTooNear> limit;
  std::optional<StartGap> start_gap;  ///< of the pair of `limit`, if it begins within a layer and ends the first window
  std::optional<NotFinite> not_finite;
  double integration = 0;  ///< what finite steps did to the energy, in all committed windows [J]
  std::optional<EnergyAstray> energy_astray;
  std::uint64_t roll_backs = 0;           ///< of windows that were run again
  bool proved = false;                    ///< proof.blocks has a proof of every window
  std::optional<std::string> no_proof;    ///< why it ends earlier
  std::uint64_t certificate_defects = 0;  ///< roll-backs that running with more layers from the start mended
  CertificateCounts certificates;
  SeriesEnd series = SeriesEnd::stopped;
  double seconds = 0, simulating_seconds = 0, verifying_seconds = 0;
  PhaseSeconds phases{};  ///< of the thread that integrates and writes
};

/// Runs the simulation. When it is asked to stop or at the time limit, it ends at the last committed window and drops
/// the one in progress. A stop before the run begins leaves no folder. A run whose windows are all committed is done,
/// whenever the stop came. After a stop it still writes series.h5, unless the user asks again to stop. Throws
/// InputError (scene), Stopped (while the scene or the run to resume is read), UsageError (the run exists, or does
/// not), WriteError (the disk is too small for the run), std::system_error (disk), std::bad_alloc.
SimulateOutcome run_simulate(const SimulateRequest& request);

struct ReproduceRequest {
  std::filesystem::path scene;
  bool brief = false;                                ///< the scene's short form
  std::filesystem::path run;                         ///< the run that has the window
  std::uint64_t window = 1;                          ///< from 1
  std::optional<std::filesystem::path> output = {};  ///< a file for the block LINE of the window (trajectory/FORMAT.md)
  const std::atomic<bool>* stop = nullptr;           ///< polled; when it becomes true, Stopped is thrown
  /// Called with what is done, and the share of it in [0, 1]: "read", the windows up to this one; then "integrate", at
  /// its beginning and its end. It comes from the calling thread.
  std::function<void(std::string_view work, double share)> progress = {};
};

struct ReproduceOutcome {
  bool same = false;                        ///< the hash is that of the run
  std::array<std::uint8_t, 32> expected{};  ///< SHA-256 of the block LINE of the run
  std::array<std::uint8_t, 32> found{};     ///< of the one that was made again
  std::uint64_t breakpoints = 0;            ///< of all vertices, the ends of the window included
};

/// Integrates one window of a run again, from the state at its beginning, and compares its world lines with the run's
/// by their hash. A run that recorded only frames has this hash too. Throws InputError (the scene, the run, no such
/// window), Stopped (`output` is then as it was), UsageError, std::system_error, std::bad_alloc.
ReproduceOutcome run_reproduce(const ReproduceRequest& request);

}  // namespace noli
