// SPDX-License-Identifier: Apache-2.0
//
// Starts the programs that lie beside this one: the host of somebody else's library, the checkers of proofs.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace noli {

/// What the program has as its descriptor `theirs`: `ours`, or /dev/null.
struct GivenDescriptor {
  static constexpr int nothing = -1;
  int theirs, ours;
};

/// Throws std::system_error, as start_process does, when this is no program that can be started.
void require_startable(const std::string& program);

/// The program is words[0], the rest its arguments; in a group of processes of its own, so that it does not share the
/// signals of the terminal. Throws std::system_error when it is not there or cannot be started.
pid_t start_process(std::vector<std::string> words, std::span<const GivenDescriptor> descriptors);

/// Whether it has ended; it can still be waited for, and its number is not another's yet.
bool has_ended(pid_t pid);

/// Waits for it to end, for at most `patience`, and returns its status; nothing when it is still there, or `stop` said
/// so.
std::optional<int> wait_for_end(pid_t pid, std::chrono::milliseconds patience, const std::function<bool()>& stop);

/// How long a program may stay once it has closed its output. It has freed its memory by then.
constexpr std::chrono::seconds time_to_stay{2};

/// What is kept of the words of a program.
constexpr std::size_t most_words = std::size_t{1} << 20;  ///< bytes

/// Appends to the words of a program what it says next, up to most_words and a note on what is cut off there.
void take_words(std::string& words, std::string_view next);

/// What a program has to clean up after itself when it is asked to end.
constexpr std::chrono::seconds time_to_end{3};

/// Ends it and what is left of its group, and returns its status: asks, and insists when it is still there after
/// `patience`. With patience a program can end its own programs and remove what it has written for itself.
int end_process(pid_t pid, std::chrono::milliseconds patience);

}  // namespace noli
