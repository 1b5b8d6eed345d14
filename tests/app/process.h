// SPDX-License-Identifier: Apache-2.0
//
// Runs the `noli` command and captures its output.
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace noli::app_tests {

/// Whether an address or thread sanitizer is active. They need memory of their own, perhaps more than a limit leaves.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

struct ProcessOptions {
  std::string program = NOLI_COMMAND;
  /// Sent once the process catches the signal and this time has passed.
  std::optional<int> signal;
  std::chrono::milliseconds signal_after{0};
  std::string standard_output;                 ///< a file to use as standard output instead of a pipe
  bool close_standard_output = false;          ///< start without one
  bool hang_up = false;                        ///< standard output is a pipe without a reader
  std::optional<std::uint64_t> address_space;  ///< limit, in bytes; none if sanitized
  std::optional<std::uint64_t> file_size;      ///< limit, in bytes; simulates a full disk
  bool obey_permissions = false;               ///< of files and folders, even when the tests are run by root
  std::vector<std::pair<std::string, std::string>> environment;  ///< variables besides those of the tests
};

struct Process {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string out, err;
  std::uint64_t peak_bytes = 0;

  /// The verdict's line without " (noli_check 0.1.0)", to compare the answers of two checkers.
  std::string verdict_of_checker() const {
    const std::string line = verdict_line();
    return line.substr(0, line.rfind(" (noli_check"));
  }

  /// The last line of standard output, without its newline: the verdict in capitals, and its place.
  std::string verdict_line() const {
    const std::string_view all = std::string_view(out).substr(0, out.find_last_not_of('\n') + 1);
    return std::string(all.substr(all.find_last_of('\n') + 1));
  }
};

/// Adds options for all programs that this process starts from now on. They have no effect without a sanitizer.
void add_sanitizer_options(const std::string& options);

/// Simulates a full disk for this process and its children. The thread sanitizer writes a file of its own before a
/// program begins, so with it children start with SIGXFSZ ignored.
void limit_file_size(std::uint64_t bytes);

/// Runs `noli` with these arguments and waits for it.
Process run_noli(const std::vector<std::string>& arguments, const ProcessOptions& options = {});

/// The same with `--json -`; returns the document. Standard output must contain only JSON.
nlohmann::json json_of(std::vector<std::string> arguments, int expected_exit_code);

/// The document as text, without values that depend on the clock or the machine.
std::string without_timing(nlohmann::json document);

/// The number of trials of a slow test: `all` with NOLI_EVERY_FAULT=1, which takes hours; else `some`.
std::uint64_t trials(std::uint64_t some, std::uint64_t all);

/// Whether the verified checker is built; if not, prints that the test runs without it.
bool verified_checker_is_there();

}  // namespace noli::app_tests
