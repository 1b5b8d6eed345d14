// SPDX-License-Identifier: Apache-2.0
//
// --time-limit, for the commands whose work hears a stop everywhere (trajectory/stop.h).
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <optional>
#include <string>

namespace noli::app {

/// --time-limit TIME, kept as text.
void add_time_limit_option(CLI::App& command, std::string& text,
                           const std::string& help = "Stop after this time, undecided: 500ms, 60s, 5m, 1h");

/// The work of a command begins: from now on Ctrl-C is heard everywhere, and so is the time limit, if `text` is not
/// empty. Returns when that is. Throws UsageError for a text that is no duration.
std::optional<std::chrono::steady_clock::time_point> begin_work(const std::string& text);

}  // namespace noli::app
