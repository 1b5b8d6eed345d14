// SPDX-License-Identifier: Apache-2.0
//
// Runs a program to its end, with a limit of time, and keeps what it says: how the fuzzers see a crash or a hang of the
// programs that they test.
//
// A program that closes both outputs and does not end within time_to_stay counts as hanging.
//
// What this does not do: it gives the program nothing to read. The programs that lie beside this one say what their
// exit codes mean; here they are just numbers.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace noli {

struct ProgramLimits {
  std::chrono::nanoseconds time{std::chrono::seconds(60)};  ///< wall clock while we look; then it hangs, and is ended
  const std::atomic<bool>* stop = nullptr;                  ///< polled; then it is ended
};

/// How a program ended.
struct ProgramEnd {
  enum class Kind { exited, signalled, hung, stopped } kind = Kind::exited;
  int code = 0;          ///< the exit code, or the signal
  std::string out, err;  ///< at most most_words of each, then a note

  bool exited_with(int expected) const { return kind == Kind::exited && code == expected; }
  /// "exit code 3", "signal 11 (Segmentation fault)", "no end within its limit of time", "stopped".
  std::string words() const;
};

/// words[0] is the program, the rest its arguments. Throws std::runtime_error when it is not there, std::system_error
/// when the machine has no process or descriptor left.
ProgramEnd run_program(std::vector<std::string> words, const ProgramLimits& limits);

/// Words as a shell reads them.
std::string shell_words(const std::vector<std::string>& words);

}  // namespace noli
