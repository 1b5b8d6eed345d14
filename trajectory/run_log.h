// SPDX-License-Identifier: Apache-2.0
//
// `log.jsonl` in the folder of a run: one JSON object a line, in the order in which things happened, across all
// resumptions.
//
// By convention each has a member "event", and whatever a clock or the machine decides stands under "timing", so that
// the rest is equal from run to run. Nothing of a run is computed from its log.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace noli {

class Sink;

class RunLog {
 public:
  /// Opens the log of a run, or makes it. A last line that was cut off, as a crash may leave one, is removed. Throws
  /// std::system_error, also when another process writes to it.
  explicit RunLog(const std::filesystem::path& folder);
  ~RunLog();

  /// Adds a line. Bytes that are no UTF-8 are replaced. Throws std::system_error.
  void append(const nlohmann::ordered_json& entry);

 private:
  std::unique_ptr<Sink> sink_;
};

}  // namespace noli
