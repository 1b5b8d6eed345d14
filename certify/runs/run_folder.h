// SPDX-License-Identifier: Apache-2.0
//
// The folder of a run: made, refused or found again; its manifest and its log. Who writes to it has it locked before
// anything in it is read, cleared or made, to the end. Files of others in it are let be.
//
// What this does not do: the motion itself (trajectory/blocks/run_file.h).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include <noli/frames.h>
#include "certify/json.h"
#include "certify/runs/run_series.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_log.h"
#include "trajectory/blocks/sha256.h"

namespace noli {

/// How many windows are committed, and the running hash behind them.
struct CommittedWindows {
  std::uint64_t count = 0;
  Sha256Digest running{};

  /// Adds them to a line of the log.
  void tell(Json& entry) const;
};

class RunFolder {
 public:
  explicit RunFolder(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }

  /// Locks the folder for as long as this object lives, if it is there. Throws UsageError when another process has it.
  void lock();

  /// Makes the folder, and locks it. Throws UsageError when there is something by that name; with `force` the files of
  /// a run that is there are removed first, but nothing that is no run, and no run that another process writes to.
  void make(bool force);

  /// Writes the manifest, with the scene as it was read: overrides applied, defaults filled in. From now on the run has
  /// begun: without a manifest there is none to go on with. `model`: hash of what the scene came to;
  /// `facts`: members of the log's first line. Precondition: the folder is locked, as for all that follows.
  void begin(const Json& scene, const Sha256Digest& model, const Json& facts);

  /// Whether there is a run to go on with, and not just what is left of one that ended before it began. Throws
  /// UsageError when the folder is no run at all, or one that has lost its manifest.
  bool has_begun() const;

  /// Goes on with it. Throws InputError when it is one of another scene, a file that the scene names has changed, or
  /// its log or manifest is damaged. The duration, the title and what is only looked at may differ. Returns what its
  /// log knows of its windows; those that are missing can be made again.
  KnownWindows go_on(const Json& scene, const Sha256Digest& model);
  /// The line of the log behind which the run goes on; `facts` as for begin(), for a log that was lost.
  void resumed(const CommittedWindows& committed, const Json& facts);

  /// Returns the hash of series.h5, once that survives a loss of power. Throws InputError, std::system_error.
  Sha256Digest keep_series() const;

  /// A line of the log for a window that has been committed. `deepest`: the deepest layer of contact that was active up
  /// to its end.
  void log(const CommittedWindows& committed, const SeriesRow& row, std::uint32_t deepest);
  /// Any other line. Precondition: `entry` has a member "event".
  void log(const Json& entry);

 private:
  std::filesystem::path path_;
  std::optional<FolderLock> lock_;
  std::optional<RunLog> log_;
  bool log_has_begun_ = false;

  void log_begin(const Json& facts);
};

/// Whether a run has a file of this name in its folder, for good or for a moment.
bool is_file_of_run(const std::filesystem::path& name);

/// The files of a run that `noli verify` reads and that do not change once it has ended: trajectory.blocks and, where
/// it is there, manifest.json, each with the SHA-256 of its bytes. Throws InputError; ReadInterrupted when `stop` says
/// true.
std::vector<FrameFacts> run_facts(const std::filesystem::path& run, const std::function<bool()>& stop);

/// Of the scene of a run. Throws InputError when its manifest or its scene is not there or damaged.
std::string title_of(const std::filesystem::path& run);

/// Of the scene of a run [s]; nothing where it has lost that or its manifest. Throws InputError when one of
/// them is damaged.
std::optional<double> duration_of(const std::filesystem::path& run);
/// The same of its windows' length.
std::optional<double> window_of(const std::filesystem::path& run);

}  // namespace noli
