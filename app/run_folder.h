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

  /// Makes the folder and its manifest, with the scene as it was read: overrides applied, defaults filled in. Throws
  /// UsageError when there is something by that name; with `force` a run that is there is removed first, but nothing
  /// that is no run.
  void make(const Json& scene, bool force);

  /// Finds a run to go on with. Throws UsageError when there is none, InputError when it is one of another scene. The
  /// duration, the title and what is only looked at may differ.
  void require_same(const Json& scene);

  /// A line of the log for a window that has been committed.
  void log(std::uint64_t window, const SeriesRow& row);
  /// Any other line. Precondition: `entry` has a member "event".
  void log(const Json& entry);

 private:
  std::filesystem::path path_;
  std::optional<RunLog> log_;
};

}  // namespace noli::app
