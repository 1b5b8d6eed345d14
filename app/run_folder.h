// SPDX-License-Identifier: Apache-2.0
//
// The folder of a run: made, refused or found again; its manifest and its log.
//
// What this does not do: the motion itself (trajectory/run_file.h).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "noli/app/json.h"
#include "noli/app/run_series.h"
#include "noli/trajectory/run_log.h"
#include "noli/trajectory/sha256.h"

namespace noli::app {

class RunFolder {
 public:
  explicit RunFolder(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }

  /// Makes the folder. Throws UsageError when there is something by that name; with `force` a run that is there is
  /// removed first, but nothing that is no run, and no run that another process writes to.
  void make(bool force);

  /// Writes the manifest, with the scene as it was read: overrides applied, defaults filled in. From now on the run has
  /// begun: without a manifest there is none to go on with. `model`: hash of what the scene came to;
  /// `facts`: members of the log's first line.
  void begin(const Json& scene, const Sha256Digest& model, const Json& facts);

  /// Whether there is a run to go on with, and not just what is left of one that ended before it began. Throws
  /// UsageError when the folder is no run at all, or one that has lost its manifest.
  bool has_begun() const;

  /// Goes on with it. Throws InputError when it is one of another scene, or a file that the scene names has changed.
  /// The duration, the title and what is only looked at may differ.
  void go_on(const Json& scene, const Sha256Digest& model);

  /// A line of the log for a window that has been committed. `deepest`: the deepest layer of contact that was active up
  /// to its end.
  void log(std::uint64_t window, const SeriesRow& row, std::uint32_t deepest);
  /// Any other line. Precondition: `entry` has a member "event".
  void log(const Json& entry);

 private:
  std::filesystem::path path_;
  std::optional<RunLog> log_;
};

/// Of the scene of a run. Throws InputError when its manifest or its scene is not there or damaged.
std::string title_of(const std::filesystem::path& run);

/// Of the scene of a run [s]; nothing where that is not there or damaged.
std::optional<double> duration_of(const std::filesystem::path& run);

}  // namespace noli::app
