// SPDX-License-Identifier: Apache-2.0
//
// Explains a wrong command line: what is wrong, and the command, option or value that was meant.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace noli::app {

/// The known word closest to `word`: one that begins with it, or at most max(2, length / 3) edits away.
std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& known);

/// The command below `app` that the command line names, as far as it is known; `rest`: what stands behind its name.
CLI::App& named_command(CLI::App& app, std::vector<std::string> arguments, std::vector<std::string>& rest);

/// `word` is no command below `app`.
std::string unknown_command(const CLI::App& app, const std::string& word);

/// One line without a full stop. Nothing if a command with subcommands was named alone: then its help says it all.
std::optional<std::string> wrong_usage(CLI::App& app, const std::vector<std::string>& arguments,
                                       const CLI::ParseError& error);

}  // namespace noli::app
