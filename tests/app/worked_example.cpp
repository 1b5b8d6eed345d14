// SPDX-License-Identifier: Apache-2.0
#include "noli/tests/app/worked_example.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>

namespace noli::app_tests {
namespace {

/// The commands of a page, which begin with "    $ ", and the line that is said to follow each.
std::vector<std::pair<std::string, std::string>> worked_example(const std::string& page) {
  std::ifstream document(std::string(NOLI_SOURCE_DIR) + "/" + page);
  std::vector<std::pair<std::string, std::string>> commands;
  for (std::string line; std::getline(document, line);) {
    if (line.starts_with("    $ ")) {
      commands.emplace_back(line.substr(6), "");
    } else if (line.starts_with("    ") && !commands.empty() && commands.back().second.empty()) {
      commands.back().second = line.substr(4);
    }
  }
  return commands;
}

/// With each `from` as `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Standard output of a line of shell, and how it ended.
std::pair<std::string, int> shell(const std::string& line) {
  std::FILE* const pipe = ::popen(line.c_str(), "r");
  std::string out;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) out += static_cast<char>(c);
  return {out, WEXITSTATUS(::pclose(pipe))};
}

}  // namespace

void expect_worked_example(const std::string& page, std::size_t commands,
                           const std::vector<std::pair<std::string, std::string>>& replacements) {
  const auto all = worked_example(page);
  ASSERT_EQ(all.size(), commands);
  std::string last_code;
  for (const auto& [command, said] : all) {
    if (command == "echo $?") {
      EXPECT_EQ(said, last_code);
      continue;
    }
    std::string line = command;
    for (const auto& [from, to] : replacements) line = replaced(line, from, to);
    const auto [out, code] = shell("cd '" + std::string(NOLI_SOURCE_DIR) + "' && " + line);
    EXPECT_EQ(out.substr(0, out.find('\n')), said) << line;
    last_code = std::to_string(code);
  }
}

}  // namespace noli::app_tests
