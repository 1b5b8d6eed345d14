// SPDX-License-Identifier: Apache-2.0
//
// Reads and writes `log.jsonl` in the folder of a run: one JSON object a line, in order of time, across all
// resumptions.
//
// By convention each has a member "event". Whatever a clock or the machine decides is under "timing", so that the rest
// is equal from run to run. The last member of each, "crc32c", is the checksum of the line before it. Nothing of a run
// is computed from its log, but what the log says about the run must be true (FORMAT.md).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace noli {

class Sink;

/// The version of the lines that are written now; the first line has it as "version".
inline constexpr int log_version = 2;

/// An entry as a line of the log, with its line end. Bytes that are not UTF-8 are replaced. Precondition: an object
/// that is not empty.
std::string log_line(const nlohmann::ordered_json& entry);

/// Reads the log of a run: its entries, without their checksums, one after another. It ignores a last line that was cut
/// off, as by a crash; a missing log has no lines. Throws InputError, naming the line, when a line is damaged or has no
/// checksum, and when the log is not a regular file or cannot be read.
void read_log_lines(const std::filesystem::path& folder,
                    const std::function<void(const nlohmann::ordered_json& entry)>& take);

class RunLog {
 public:
  /// Opens the log of a run, or creates it. A last line that was cut off is removed. Throws what read_log_lines()
  /// throws, and std::system_error, also when another process writes to the log.
  explicit RunLog(const std::filesystem::path& folder);
  ~RunLog();

  /// Adds the line that log_line() gives; it then survives a loss of power. Throws std::system_error.
  void append(const nlohmann::ordered_json& entry);

 private:
  std::unique_ptr<Sink> sink_;
};

}  // namespace noli
