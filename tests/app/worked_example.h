// SPDX-License-Identifier: Apache-2.0
//
// The worked examples of pages of documentation, so that tests can do what they say.
#pragma once

#include <cstdio>
#include <fstream>
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

}  // namespace noli::app_tests
