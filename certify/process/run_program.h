// SPDX-License-Identifier: Apache-2.0
//
// Runs a program to its end and keeps what it says: how audits and fuzzers see an answer, a crash or a hang.
//
// What this does not do: it gives the program nothing to read. The programs that lie beside this one say what their
// exit codes mean; here they are just numbers.
#pragma once

#include <string>
#include <vector>

#include "certify/process/child.h"

namespace noli {

/// words[0] is the program, the rest its arguments. Throws std::system_error when it is not there, or the machine has
/// no process or descriptor left.
ProgramEnd run_program(std::vector<std::string> words, const ProgramLimits& limits);

/// Words as a shell reads them.
std::string shell_words(const std::vector<std::string>& words);

}  // namespace noli
