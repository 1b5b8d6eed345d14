// SPDX-License-Identifier: Apache-2.0
//
// Runs the worked examples of the documentation, which have two forms.
//   examples   lines of a page indented by four spaces: those that begin with "$ " are commands, and the last line
//              after each is the last line of its output
//   tutorials  fenced blocks: blocks of the language `console` contain commands and their standard output; code blocks
//              with a `:caption:` are files of that name
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace noli::app_tests {

struct ExampleCommand {
  std::string line;  ///< without "$ "
  std::string said;  ///< the last line of its output; "" if the page shows none
};

/// The commands in the section of a page that begins with the line `heading`; without one, of the whole page.
std::vector<ExampleCommand> worked_example(const std::string& page, const std::string& heading = "");

std::string replaced(std::string text, const std::string& from, const std::string& to);

/// Standard output and exit code.
std::pair<std::string, int> shell(const std::string& line);

/// Runs the commands one after the other in the source folder, with the first of each pair of `places` replaced by the
/// second. Expects the last lines shown on the page, up to `end`; for "echo $?", the exit code of the command before.
void expect_worked_example(const std::vector<ExampleCommand>& commands,
                           const std::vector<std::pair<std::string, std::string>>& places,
                           const std::string& end = "\n");

/// One action of a tutorial's reader: writing a file or running a command.
struct TutorialStep {
  std::string file;                  ///< the name of the file; "" for a command
  std::string text;                  ///< the file's content, or the command without "$ "
  std::vector<std::string> printed;  ///< the lines that the command prints
};

/// The steps in the order of the page.
std::vector<TutorialStep> tutorial(const std::string& page);

/// Whether a line matches a tutorial's line, in which "..." stands for any characters.
bool is_like(const std::string& expected, const std::string& line);

/// The same for all lines; a line "..." stands for any lines.
bool are_like(const std::vector<std::string>& expected, const std::vector<std::string>& lines);

/// Follows a tutorial in `folder`, with `noli` first on PATH and NOLI naming the folder of the sources.
void expect_tutorial(const std::string& page, const std::string& folder);

}  // namespace noli::app_tests
