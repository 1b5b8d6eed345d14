// SPDX-License-Identifier: Apache-2.0
//
// The folder of a run: made, refused or found again; its manifest and its log.
//
// What this does not do: the motion itself (trajectory/run_file.h).
#pragma once

#include <filesystem>
#include <optional>

#include "noli/app/json.h"
#include "noli/app/run_series.h"
#include "noli/trajectory/run_log.h"

namespace noli::app {

class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }

  /// Makes the folder. Throws UsageError when there is something by that name; with `force` a run that is there is
  /// removed first, but nothing that is no run.
  void make(bool force);

  /// Writes the manifest, with the scene as it was read: overrides applied, defaults filled in. From now on the run has
  /// begun: without a manifest there is none to go on with.
  void begin(const Json& scene);

  /// Whether there is a run to go on with, and not just what is left of one that ended before it began. Throws
  /// UsageError when the folder is no run at all.
  bool has_begun() const;

  /// Goes on with it. Throws InputError when it is one of another scene. The duration, the title and what is only
  /// looked at may differ.
  void go_on(const Json& scene);

  /// A line of the log for a window that has been committed.
  void log(std::uint64_t window, const SeriesRow& row);
  /// Any other line. Precondition: `entry` has a member "event".
  void log(const Json& entry);

 private:
  std::filesystem::path path_;
  std::optional<RunLog> log_;
};

}  // namespace noli::app
