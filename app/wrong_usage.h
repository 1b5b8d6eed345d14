// SPDX-License-Identifier: Apache-2.0
//
// What to say of a command line that cannot be: what is wrong, and the command, option or value that was meant.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace noli::app {

/// The one that a person meant who wrote `word`: it begins so, or two letters or a third of them are otherwise.
std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& known);

/// The command below `app` that the command line names, as far as it is known; `rest`: what stands behind its name.
CLI::App& named_command(CLI::App& app, std::vector<std::string> arguments, std::vector<std::string>& rest);

/// For a word that is none of the commands below `app`.
std::string unknown_command(const CLI::App& app, const std::string& word);

/// One line without a full stop. Nothing if a command with subcommands was named alone: then its help says it all.
std::optional<std::string> wrong_usage(CLI::App& app, const std::vector<std::string>& arguments,
                                       const CLI::ParseError& error);

}  // namespace noli::app
