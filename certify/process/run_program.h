// SPDX-License-Identifier: Apache-2.0
//
// Runs a program until it ends and keeps its output, so that audits and fuzzers see an answer, a crash or a hang.
//
// The program's standard input is empty.
#pragma once

#include <string>
#include <vector>

#include "certify/process/child.h"

namespace noli {

/// words[0] is the program, the rest its arguments. Throws std::system_error when there is no such program, or the
/// machine has no process or descriptor left.
ProgramEnd run_program(std::vector<std::string> words, const ProgramLimits& limits);

/// The words as a command line for a shell, quoted where needed.
std::string shell_words(const std::vector<std::string>& words);

}  // namespace noli
