// SPDX-License-Identifier: Apache-2.0
//
// The worked examples of the documentation: lines of a page that are indented by four blanks, of which those that begin
// with "$ " are commands and the first one behind each is the first line of what it prints.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace noli::app_tests {

struct ExampleCommand {
  std::string line;  ///< without "$ "
  std::string said;  ///< the last line that it prints; "" where nothing is said to follow
};

/// Those of the part of a page that begins with the line `heading` and ends where a heading of the same depth begins;
/// without one, of the whole page.
std::vector<ExampleCommand> worked_example(const std::string& page, const std::string& heading = "");

std::string replaced(std::string text, const std::string& from, const std::string& to);

/// Standard output, and how it ended.
std::pair<std::string, int> shell(const std::string& line);

/// Runs the commands one after the other in the folder of the sources, with each pair of `places` replaced by what it
/// is here, and expects what they are said to print, up to `end`; after "echo $?", the exit code of the one before.
void expect_worked_example(const std::vector<ExampleCommand>& commands,
                           const std::vector<std::pair<std::string, std::string>>& places,
                           const std::string& end = "\n");

}  // namespace noli::app_tests
