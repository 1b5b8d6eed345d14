// SPDX-License-Identifier: Apache-2.0
//
// The worked examples of pages of documentation, so that tests can do what they say.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace noli::app_tests {

/// The commands of a page, which begin with "    $ ", and the line that is said to follow each. `page` is a path from
/// the root of the sources.
inline std::vector<std::pair<std::string, std::string>> worked_example(const std::string& page) {
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

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Standard output, and how it ended.
inline std::pair<std::string, int> shell(const std::string& line) {
  std::FILE* const pipe = ::popen(line.c_str(), "r");
  std::string out;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) out += static_cast<char>(c);
  return {out, WEXITSTATUS(::pclose(pipe))};
}

/// The same up to the first place where `end` stands, or all of it.
inline std::string up_to(const std::string& text, const std::string& end) { return text.substr(0, text.find(end)); }

/// Does what the page says, in the root of the sources, with the `noli` that was built: the first line of each
/// command's output has to be what the page says, up to `end`, and `echo $?` its exit code. `adapt` puts other places
/// for those that the page names. Returns how many commands there were.
inline std::size_t follow_worked_example(const std::string& page, const std::string& end,
                                         const std::function<std::string(std::string)>& adapt) {
  const auto commands = worked_example(page);
  std::string last_code;
  for (const auto& [command, said] : commands) {
    if (command == "echo $?") {
      EXPECT_EQ(said, last_code);
      continue;
    }
    const std::string line = adapt(replaced(command, "build/release/app/noli", NOLI_COMMAND));
    const auto [out, code] = shell("cd '" + std::string(NOLI_SOURCE_DIR) + "' && " + line);
    EXPECT_EQ(up_to(up_to(out, "\n"), end), up_to(said, end)) << line;
    last_code = std::to_string(code);
  }
  return commands.size();
}

}  // namespace noli::app_tests
