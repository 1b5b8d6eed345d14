// SPDX-License-Identifier: Apache-2.0
//
// Help texts: examples first, then what most people need, then the rest. At most 100 columns.
//
// A command's footer has its details and, behind a line "Examples:", its examples. Options stand in groups in this
// order: those without a group, which a first use needs; "What is asked"; all others; "Output"; "Limits".
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace noli::app {

/// Groups of options. In each command those of `question` change what is claimed.
namespace group {
inline constexpr const char* question = "What is asked";
inline constexpr const char* output = "Output";
inline constexpr const char* limits = "Limits";
}  // namespace group

/// Makes this the help of a command and of all below it that are added later.
void use_help(CLI::App& app);

/// The help of this command; CLI::App::help() is that of the command below it that was given.
std::string help_of(const CLI::App& app);

/// "--until SECONDS", "FRAMES | RUN"
std::string option_in_words(const CLI::Option& option);

/// "noli fuzz queries"
std::string full_name(const CLI::App& app);

}  // namespace noli::app
