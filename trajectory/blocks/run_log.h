// SPDX-License-Identifier: Apache-2.0
//
// `log.jsonl` in the folder of a run: one JSON object a line, in the order in which things happened, across all
// resumptions.
//
// By convention each has a member "event", and whatever a clock or the machine decides stands under "timing", so that
// the rest is equal from run to run. The last member of each, "crc32c", is the checksum of the line before it. Nothing
// of a run is computed from its log; but what a log tells of its run has to be so (FORMAT.md).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace noli {

class Sink;

/// Of the lines that are written now; the first one has it as "version".
inline constexpr int log_version = 2;

/// An entry as a line of the log, its end included. Bytes that are no UTF-8 are replaced. Precondition: an object that
/// is not empty.
std::string log_line(const nlohmann::ordered_json& entry);

/// Reads the log of a run: its entries, without their checksums, one after another. A last line that was cut off, as a
/// crash may leave one, is left out; a log that is not there has no lines. Throws InputError, naming the line, when one
/// is damaged or has no checksum, and when the log is no regular file or cannot be read.
void read_log_lines(const std::filesystem::path& folder,
                    const std::function<void(const nlohmann::ordered_json& entry)>& take);

class RunLog {
 public:
  /// Opens the log of a run, or makes it. A last line that was cut off is removed. Throws what read_log_lines() throws,
  /// and std::system_error, also when another process writes to it.
  explicit RunLog(const std::filesystem::path& folder);
  ~RunLog();

  /// Adds a line, as log_line() has it; after this it survives a loss of power. Throws std::system_error.
  void append(const nlohmann::ordered_json& entry);

 private:
  std::unique_ptr<Sink> sink_;
};

}  // namespace noli
