// SPDX-License-Identifier: Apache-2.0
#include "tests/app/worked_example.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>

namespace noli::app_tests {

namespace {

std::size_t depth(const std::string& line) {
  const std::size_t marks = line.find_first_not_of('#');
  return marks != std::string::npos && line[marks] == ' ' ? marks : 0;
}

/// The text before `end`; all of it if it does not contain `end`.
std::string up_to(const std::string& text, const std::string& end) { return text.substr(0, text.find(end)); }

std::string last_line(const std::string& text) {
  const std::string whole = text.substr(0, text.find_last_not_of('\n') + 1);
  return whole.substr(whole.find_last_of('\n') + 1);
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string block_text(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// The remaining lines of a fenced block.
std::vector<std::string> rest_of_block(std::istream& page) {
  std::vector<std::string> lines;
  for (std::string line; std::getline(page, line) && line != "```";) lines.push_back(line);
  return lines;
}

/// The file of a block; empty if the block names no file.
std::vector<TutorialStep> file_of(const std::vector<std::string>& block) {
  const std::string caption = ":caption: ";
  if (block.size() < 2 || !block[0].starts_with(caption) || !block[1].empty()) return {};
  return {{block[0].substr(caption.size()), block_text({block.begin() + 2, block.end()}), {}}};
}

std::vector<TutorialStep> commands_of(const std::vector<std::string>& block) {
  std::vector<TutorialStep> commands;
  for (const std::string& line : block) {
    if (line.starts_with("$ ")) {
      commands.push_back({"", line.substr(2), {}});
    } else if (!commands.empty()) {
      commands.back().printed.push_back(line);
    }
  }
  return commands;
}

bool lines_are_like(std::span<const std::string> expected, std::span<const std::string> lines) {
  if (expected.empty()) return lines.empty();
  if (expected.front() != "...") {
    return !lines.empty() && is_like(expected.front(), lines.front()) &&
           lines_are_like(expected.subspan(1), lines.subspan(1));
  }
  for (std::size_t skipped = 0; skipped <= lines.size(); ++skipped) {
    if (lines_are_like(expected.subspan(1), lines.subspan(skipped))) return true;
  }
  return false;
}

/// Replaces `cc` in a tutorial with the compiler of the tests.
std::string with_compiler(const std::string& line) {
  return line.starts_with("cc ") ? std::string(NOLI_C_COMPILER) + line.substr(2) : line;
}

}  // namespace

std::vector<ExampleCommand> worked_example(const std::string& page, const std::string& heading) {
  std::ifstream document(std::string(NOLI_SOURCE_DIR) + "/" + page);
  std::vector<ExampleCommand> commands;
  bool inside = heading.empty(), printing = false;
  for (std::string line; std::getline(document, line);) {
    if (!heading.empty() && depth(line) > 0 && depth(line) <= depth(heading)) inside = line == heading;
    if (!inside) continue;
    if (line.starts_with("    $ ")) {
      commands.push_back({line.substr(6), ""});
      printing = true;
    } else if (line.starts_with("    ") && printing) {
      commands.back().said = line.substr(4);
    } else {
      printing = false;
    }
  }
  return commands;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::pair<std::string, int> shell(const std::string& line) {
  std::FILE* const pipe = ::popen(line.c_str(), "r");
  std::string out;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) out += static_cast<char>(c);
  return {out, WEXITSTATUS(::pclose(pipe))};
}

void expect_worked_example(const std::vector<ExampleCommand>& commands,
                           const std::vector<std::pair<std::string, std::string>>& places, const std::string& end) {
  std::string last_code;
  for (const ExampleCommand& command : commands) {
    if (command.line == "echo $?") {
      EXPECT_EQ(command.said, last_code);
      continue;
    }
    std::string line = command.line, said = command.said;
    for (const auto& [from, to] : places) {
      line = replaced(line, from, to);
      said = replaced(said, from, to);
    }
    const auto [out, code] = shell("cd '" + std::string(NOLI_SOURCE_DIR) + "' && " + line);
    EXPECT_EQ(up_to(last_line(out), end), up_to(said, end)) << line;
    last_code = std::to_string(code);
  }
}

std::vector<TutorialStep> tutorial(const std::string& page) {
  std::ifstream document(std::string(NOLI_SOURCE_DIR) + "/" + page);
  std::vector<TutorialStep> steps;
  for (std::string line; std::getline(document, line);) {
    if (!line.starts_with("```")) continue;
    const std::vector<std::string> block = rest_of_block(document);
    const std::vector<TutorialStep> more = line == "```console" ? commands_of(block) : file_of(block);
    steps.insert(steps.end(), more.begin(), more.end());
  }
  return steps;
}

bool is_like(const std::string& expected, const std::string& line) {
  const std::string any = "...";
  const std::size_t first = expected.find(any);
  if (first == std::string::npos) return line == expected;
  if (!line.starts_with(expected.substr(0, first))) return false;
  std::size_t at = first;  // the line is matched up to here
  std::size_t begin = first + any.size();
  for (std::size_t end = expected.find(any, begin); end != std::string::npos; end = expected.find(any, begin)) {
    const std::string part = expected.substr(begin, end - begin);
    const std::size_t found = line.find(part, at);
    if (found == std::string::npos) return false;
    at = found + part.size();
    begin = end + any.size();
  }
  const std::string last = expected.substr(begin);
  return line.size() >= at + last.size() && line.ends_with(last);
}

bool are_like(const std::vector<std::string>& expected, const std::vector<std::string>& lines) {
  return lines_are_like(std::span<const std::string>(expected), std::span<const std::string>(lines));
}

void expect_tutorial(const std::string& page, const std::string& folder) {
  const std::string programs = std::filesystem::path(NOLI_COMMAND).parent_path().string();
  const std::string begin =
      "cd '" + folder + "' && export NOLI='" + NOLI_SOURCE_DIR + "' PATH='" + programs + "':\"$PATH\" && ";
  const std::vector<TutorialStep> steps = tutorial(page);
  EXPECT_FALSE(steps.empty()) << page;
  std::string last_code;
  for (const TutorialStep& step : steps) {
    if (!step.file.empty()) {
      std::ofstream(folder + "/" + step.file) << step.text;
    } else if (step.text == "echo $?") {
      EXPECT_EQ(block_text(step.printed), last_code + "\n") << page;
    } else {
      const auto [out, code] = shell(begin + with_compiler(step.text));
      EXPECT_TRUE(are_like(step.printed, split_lines(out))) << page << ": " << step.text << "\nprints\n"
                                                            << out << "expected\n"
                                                            << block_text(step.printed);
      last_code = std::to_string(code);
    }
  }
}

}  // namespace noli::app_tests
