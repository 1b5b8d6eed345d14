// SPDX-License-Identifier: Apache-2.0
#include "tests/app/worked_example.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>

namespace noli::app_tests {

namespace {

std::size_t depth(const std::string& line) {
  const std::size_t marks = line.find_first_not_of('#');
  return marks != std::string::npos && line[marks] == ' ' ? marks : 0;
}

/// All of a text, if `end` is not in it.
std::string up_to(const std::string& text, const std::string& end) { return text.substr(0, text.find(end)); }

std::string last_line(const std::string& text) {
  const std::string whole = text.substr(0, text.find_last_not_of('\n') + 1);
  return whole.substr(whole.find_last_of('\n') + 1);
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

}  // namespace noli::app_tests
