// SPDX-License-Identifier: Apache-2.0
//
// The folder of a run, with its manifest and log: creates it, refuses it or goes on with it. A writer locks it before
// it reads, clears or creates anything in it, and keeps the lock to the end. Other files in it are left alone.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <noli/frames.h>
#include "certify/json.h"
#include "certify/runs/run_series.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_log.h"
#include "trajectory/blocks/sha256.h"

namespace noli {

/// How many windows are committed, and the running hash after them.
struct CommittedWindows {
  std::uint64_t count = 0;
  Sha256Digest running{};

  /// Adds them to a line of the log.
  void tell(Json& entry) const;
};

/// Locks a folder against other writers. Throws UsageError, naming the option, when another has the lock, or the folder
/// cannot be opened.
void lock_folder(const std::filesystem::path& folder, const std::string& option, std::optional<FolderLock>& lock);

class RunFolder {
 public:
  /// `option`: the one that names the folder, for errors.
  explicit RunFolder(const std::filesystem::path& path, std::string option = "-o");

  const std::filesystem::path& path() const { return path_; }

  /// Locks the folder, if it exists, as long as this object lives. Throws UsageError when another process has the lock.
  void lock();

  /// Creates and locks the folder. Throws UsageError when the name exists. With `force` it removes the files of an
  /// existing run first, and throws UsageError for anything else, or for a run that another process writes to.
  void make(bool force);
  /// The same without removing files: make() will not throw UsageError.
  void claim(bool force);
  /// Throws UsageError when make() would, because of what is there, and changes nothing.
  void require_room(bool force) const;

  /// Writes the manifest, with the scene as it was read: overrides applied, defaults filled in. From now on the run has
  /// begun: without a manifest it cannot be resumed. `model`: hash of the model made from the scene; `facts`: members
  /// of the log's first line. Precondition, here and below: the folder is locked.
  void begin(const Json& scene, const Sha256Digest& model, const Json& facts);

  /// Whether there is a run to go on with, and not just the remains of one that ended before it began. Throws
  /// UsageError when the folder is not a run, or has lost its manifest.
  bool has_begun() const;

  /// Goes on with the run. Throws InputError when it is a run of another scene, a file that the scene names has
  /// changed, or its log or manifest is damaged. Fields of the scene that do not change the run's bytes, such as the
  /// duration and the title, may differ. Returns what its log says about its windows; missing ones can be made again.
  KnownWindows go_on(const Json& scene, const Sha256Digest& model);
  /// Logs that the run is resumed; `facts` as for begin(), for a log that was lost.
  void resumed(const CommittedWindows& committed, const Json& facts);

  /// Makes series.h5 survive a loss of power, and returns its hash. Throws InputError, std::system_error.
  Sha256Digest keep_series() const;

  /// Logs a window that has been committed. `deepest`: the deepest layer of contact that was active up to its end.
  void log(const CommittedWindows& committed, const SeriesRow& row, std::uint32_t deepest);
  /// The same for a window without a row.
  void log(const CommittedWindows& committed, double time, std::uint64_t breakpoints);
  /// Logs any other line. Precondition: `entry` has a member "event".
  void log(const Json& entry);

 private:
  std::filesystem::path path_;
  std::string option_;
  std::optional<FolderLock> lock_;
  std::optional<RunLog> log_;
  bool log_has_begun_ = false;

  void log_begin(const Json& facts);
  static Json window_line(const CommittedWindows& committed, double time, std::uint64_t breakpoints);
};

/// Whether a run has a file of this name in its folder, even if only for a moment.
bool is_file_of_run(const std::filesystem::path& name);

/// The files of a run that `noli verify` reads and that do not change after it has ended: trajectory.blocks and, if it
/// exists, manifest.json, each with the SHA-256 of its bytes. Throws InputError; ReadInterrupted when `stop` returns
/// true.
std::vector<FrameFacts> run_facts(const std::filesystem::path& run, const std::function<bool()>& stop);

/// The title of a run's scene. Throws InputError when its manifest or its scene is missing or damaged.
std::string title_of(const std::filesystem::path& run);

/// The duration of a run's scene [s]; nothing if the run has lost its scene or manifest. Throws InputError when one of
/// them is damaged.
std::optional<double> duration_of(const std::filesystem::path& run);
/// The same for the length of its windows.
std::optional<double> window_of(const std::filesystem::path& run);

}  // namespace noli
