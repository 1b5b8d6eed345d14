// SPDX-License-Identifier: Apache-2.0
//
// Starts the programs that lie beside this one: the host of somebody else's library, the checkers of proofs.
#pragma once

#include <sys/types.h>

#include <span>
#include <string>
#include <vector>

namespace noli::audit {

/// What the program has as its descriptor `theirs`: `ours`, or /dev/null.
struct GivenDescriptor {
  static constexpr int nothing = -1;
  int theirs, ours;
};

/// The program is words[0], the rest its arguments; in a group of processes of its own, so that it does not share the
/// signals of the terminal. Throws std::runtime_error when it is not there, std::system_error when it cannot be started.
pid_t start_process(std::vector<std::string> words, std::span<const GivenDescriptor> descriptors);

}  // namespace noli::audit
