// SPDX-License-Identifier: Apache-2.0
//
// Keeps the motion of a repair as a run (trajectory/FORMAT.md), beside its frames: each step is a window of one second,
// in which vertices move as the filter moved them. Times of a run are rounded; where that makes the motion touch, the
// window has the straight lines between the step's frames instead. Either way it was decided exactly.
//
// A window is committed before the frames of its step are. After a repair was killed, the run may therefore have
// windows whose steps are repaired once more; these stay, as they come to the same motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
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
  RunScene run;  ///< with record full
  std::string title;
  std::string pattern;          ///< of the new frames
  std::size_t steps = 0;        ///< that are given
  Sha256Digest fingerprint{};   ///< of everything that decides what is written
  Json bodies = Json::array();  ///< for the log
};

class RepairedRun {
 public:
  /// Locks the folder if it exists. The options are those of each window. Throws UsageError.
  RepairedRun(const std::filesystem::path& folder, RepairedScene scene, const WindowOptions& options);

  /// Throws UsageError if the folder has something that is not to be replaced; changes nothing.
  void require_room(bool force) const { folder_.require_room(force); }
  /// Creates the folder for a new run. With `force` a run in it may be replaced, with `resume` one of this repair.
  /// Throws UsageError, InputError: then nothing has been removed.
  void claim(bool force, bool resume);
  /// Removes what is in the folder of a run, and begins the new one. Precondition: claim(). Throws std::system_error.
  void begin();
  /// Goes on after so many steps, the last of which ends at x. False if `stop` returned true. Throws UsageError,
  /// InputError: no run, or not of this repair.
  bool go_on(std::size_t steps, std::span<const Position> x, const std::function<bool()>& stop);

  /// The next step, on straight lines from x to y, which have been decided.
  void add_straight(std::span<const Position> x, const std::vector<Position>& y);
  /// The next step, as it was filtered, if nothing touches then; else on straight lines from x through its frames at
  /// these times, which have been decided. False if a limit came first. `times`: in (0, 1], the last is 1.
  bool add(const FilteredStep& moved, std::span<const Position> x, std::span<const double> times);
  /// Logs why the repair ended, as a run's log says it, unless the run has windows behind the repair and `stop` returns
  /// true before they are read. Throws InputError, std::system_error.
  void finish(const char* why, const std::function<bool()>& stop);

  bool has_begun() const { return reader_ || writer_; }
  std::uint64_t straight_windows() const { return straight_windows_; }  ///< by add(), with straight lines

 private:
  bool take_existing(std::span<const Position> end);
  void write(const WorldLines& lines);
  void start_writing();
  int dimension() const { return static_cast<int>(scene_.run.header.dimension); }
  std::vector<Position> in_run(std::span<const Position> x) const;
  Json document() const;
  Json facts() const { return {{"bodies", scene_.bodies}}; }
  CommittedWindows committed() const { return {writer_->windows(), writer_->running_hash()}; }
  void require_this_repair() const;
  [[noreturn]] void refuse(const char* why) const;

  RepairedScene scene_;
  WindowOptions options_;
  std::optional<WindowVerifier> verifier_;  ///< since the first step that was filtered
  RunFolder folder_;
  std::optional<RunReader> reader_;  ///< as long as the run may have the next window already
  std::optional<RunWriter> writer_;
  std::uint64_t logged_ = 0;  ///< windows that the log has
  std::size_t steps_ = 0;     ///< that have been added
  std::uint64_t straight_windows_ = 0;
};

}  // namespace noli
