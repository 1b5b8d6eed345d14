// SPDX-License-Identifier: Apache-2.0
//
// Integrates the windows of a run again, one after another, from its own scene and states, for `noli verify RUN
// --reproduce` on runs that recorded only frames.
//
// It trusts no number that it integrates: world lines count only if their hash is the one in the run.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "certify/runs/run_series.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

class ReproducedWindows {
 public:
  /// For the run in this folder, whose reader has given `scene`. `files`: the folder where the scene's file was, to
  /// which the paths of its meshes are relative; nothing: the run's own. Throws InputError when the run's scene.json is
  /// missing, is damaged, or gives another model than it did; UsageError when files that it names are missing.
  static std::unique_ptr<ReproducedWindows> of(const std::filesystem::path& run,
                                               const std::optional<std::filesystem::path>& files, const RunScene& scene,
                                               const std::function<bool()>& stop);
  virtual ~ReproducedWindows() = default;

  /// The positions of all vertices at the beginning of the run.
  virtual std::vector<Position> beginning() const = 0;
  /// Makes the window after this one the next, without integrating this one. `state`: that of the window.
  virtual void continue_after(const RunWindow& window, const WindowState& state) = 0;

  /// The world lines of the next window; nothing if `stop` returned true. `state`: that of the window. Throws
  /// InputError when their hash, or the state at their end, is not that of the run.
  virtual std::optional<WorldLines> next(const RunWindow& window, const WindowState& state) = 0;
};

}  // namespace noli
