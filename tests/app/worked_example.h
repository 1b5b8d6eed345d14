// SPDX-License-Identifier: Apache-2.0
//
// The worked examples of the documentation, in two forms.
//   examples   lines of a page that are indented by four blanks: those that begin with "$ " are commands, and the last
//              line behind each is the last one that it prints
//   tutorials  fenced blocks: those of the language `console` have commands and all that they print on standard output;
//              code blocks with a `:caption:` are files of that name
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

/// What a reader of a tutorial does: write a file, or run a command.
struct TutorialStep {
  std::string file;                  ///< the name of the file; "" for a command
  std::string text;                  ///< what is in the file, or the command without "$ "
  std::vector<std::string> printed;  ///< the lines that the command prints
};

/// In the order of the page.
std::vector<TutorialStep> tutorial(const std::string& page);

/// Whether a line is like the one of a tutorial, in which "..." stands for any characters.
bool is_like(const std::string& expected, const std::string& line);

/// The same of all lines, among which "..." stands for any lines.
bool are_like(const std::vector<std::string>& expected, const std::vector<std::string>& lines);

/// Follows a tutorial in `folder`, with `noli` first on PATH and NOLI naming the folder of the sources.
void expect_tutorial(const std::string& page, const std::string& folder);

}  // namespace noli::app_tests
