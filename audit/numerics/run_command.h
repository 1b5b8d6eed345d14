// SPDX-License-Identifier: Apache-2.0
//
// Runs a program as a user would, `noli` itself among them, and keeps what it says: for audits that judge a command by
// its output, its files and its exit code.
//
// What this does not do: it gives the program no input, and it does not limit its memory.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "trajectory/text.h"

namespace noli::audit {

struct CommandRun {
  enum class End {
    exited,
    signalled,  ///< it crashed, or somebody else ended it
    hung,       ///< it was ended when its time was up
    stopped     ///< it was ended because the user asks to stop
  };

  End end = End::exited;
  int code = -1;         ///< exit code, or the number of the signal
  std::string out, err;  ///< also of what was ended; at most most_words of each, then a note
  double seconds = 0;    ///< by the wall clock

  bool exited(int with) const { return end == End::exited && code == with; }
  /// The first line of its output, without its end.
  std::string verdict_line() const { return first_line(out); }
};

/// "exit 3", "signal 11", "no end after 20 s", "stopped".
std::string end_words(const CommandRun& run);

/// words[0] is the program, a path. `limit`: it is ended, with what it has started, when it has run for so long.
/// `stop` may be null. Throws as start_process() does; std::system_error when the machine gives no memory or process.
CommandRun run_command(const std::vector<std::string>& words, std::chrono::nanoseconds limit,
                       const std::atomic<bool>* stop);

}  // namespace noli::audit
