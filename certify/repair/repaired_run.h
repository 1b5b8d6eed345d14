// SPDX-License-Identifier: Apache-2.0
//
// Keeps the motion of a repair as a run (trajectory/FORMAT.md), beside its frames: each step is a window of one second,
// in which vertices move as the filter moved them. So `noli verify RUN` decides that motion again.
//
// A window is committed before the frames of its step are. After a repair was killed, the run may therefore have
// windows whose steps are repaired once more; these stay, as they come to the same motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certify/json.h"
#include "certify/repair/step_filter.h"
#include "certify/runs/run_folder.h"
#include "proofs/prover/windows/window_verifier.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

/// What a run keeps of a repair besides its motion.
struct RepairedScene {
  RunScene run;           ///< with record full
  Json document;          ///< scene.json: title, duration and window as scenes have them
  Sha256Digest repair{};  ///< of all that decides what is written
  Json facts;             ///< members of the log's first line
};

class RepairedRun {
 public:
  /// Locks the folder if it exists. `x`: the first frame. The options are those of each window. Throws UsageError.
  RepairedRun(const std::filesystem::path& folder, RepairedScene scene, std::span<const Position> x,
              const WindowOptions& options);

  /// Throws what begin() would.
  void require_room(bool replace) const { folder_.require_room(replace); }
  /// Creates the folder, in place of a run that is there with `replace`. Throws UsageError, std::system_error.
  void begin(bool replace);
  /// Goes on after so many steps, the last of which ends at x. Throws UsageError, InputError: no run, or not of this
  /// repair; Stopped.
  void go_on(std::size_t steps, std::span<const Position> x);

  /// The next step, on straight lines from x to y, which have been decided.
  void add_straight(std::span<const Position> x, const std::vector<Position>& y);
  /// The next step, as it was filtered, if nothing touches then; else on straight lines from x through its frames at
  /// these times, which have been decided. False if a limit came first. `times`: in (0, 1], the last is 1.
  bool add(const FilteredStep& moved, std::span<const Position> x, std::span<const double> times);
  /// Throws InputError, std::system_error.
  void finish(const char* why);

  std::uint64_t straight() const { return straight_; }  ///< windows that add() kept as straight lines

 private:
  bool is_there_already(std::span<const Position> end);
  void write(const WorldLines& lines, std::span<const Position> end);
  void start_writing();
  int dimension() const { return static_cast<int>(scene_.run.header.dimension); }
  /// In two dimensions without a third coordinate.
  std::vector<Position> in_run(std::span<const Position> x) const;
  [[noreturn]] void refuse() const;

  RepairedScene scene_;
  WindowOptions options_;
  WindowVerifier verifier_;
  RunFolder folder_;
  std::optional<RunReader> reader_;  ///< as long as the run may have the next window already
  std::optional<RunWriter> writer_;
  std::size_t steps_ = 0;  ///< that have been added
  std::uint64_t straight_ = 0;
};

}  // namespace noli
