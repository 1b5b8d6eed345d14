// SPDX-License-Identifier: Apache-2.0
//
// The windows of a run integrated again, one after another, from its own scene and states: what `noli verify RUN
// --reproduce` verifies where only frames were recorded.
//
// What this does not do: it trusts no number that it integrates. World lines count only when their hash is the one that
// the run has.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "certify/runs/run_series.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

class WindowsAgain {
 public:
  /// Of the run in this folder, whose reader has given `scene`. `files`: the folder in which the scene's file was, from
  /// which the paths of its meshes begin; nothing: the run's own. Throws InputError when the run's scene.json is not
  /// there, is damaged, or has come to another model than it did; UsageError when files that it names are not there.
  static std::unique_ptr<WindowsAgain> of(const std::filesystem::path& run,
                                          const std::optional<std::filesystem::path>& files, const RunScene& scene,
                                          const std::function<bool()>& stop);
  virtual ~WindowsAgain() = default;

  /// The world lines of the window behind the one before; nothing when `stop` said so. `state`: its own. Throws
  /// InputError when their hash, or the state that they end in, is not the one that the run has.
  virtual std::optional<WorldLines> next(const RunWindow& window, const WindowState& state) = 0;
};

}  // namespace noli
