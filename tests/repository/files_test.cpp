// SPDX-License-Identifier: Apache-2.0
//
// Checks every file of the project: licences, sizes, no private paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

/// The first absolute path in the text that only means something on one machine; empty if there is none.
std::string private_path(const std::string& text) {
  static const std::regex pattern(R"((^|[^A-Za-z0-9_.$}/-])(/(home|work|root|Users|mnt|media)/[A-Za-z0-9_.-]+))");
  std::smatch match;
  return std::regex_search(text, match, pattern) ? match[2].str() : "";
}

/// Where an SPDX line has to be: first, or second after `#!`.
bool states_licence(std::string_view text) {
  if (text.starts_with("#!")) text.remove_prefix(std::min(text.size(), text.find('\n') + 1));
  return text.substr(0, text.find('\n')).find("SPDX-License-Identifier: Apache-2.0") != std::string_view::npos;
}

bool is_code(const fs::path& path) {
  return is_cpp(path) || path.extension() == ".cmake" || path.filename() == "CMakeLists.txt" ||
         (path.parent_path().filename() == "scripts" && path.extension() == "");
}

TEST(Files, NoneNamesAPathOfOneMachine) {
  for (const fs::path& file : files_below(NOLI_SOURCE_DIR)) EXPECT_EQ(private_path(read_text(file)), "") << file;
}

TEST(Files, APlantedPathIsFound) {
  const std::string root = "/";
  EXPECT_EQ(private_path("see " + root + "home/me/x"), root + "home/me");
  EXPECT_EQ(private_path(root + "work/x"), root + "work/x");
  EXPECT_EQ(private_path("-I\"" + root + "root/a b\""), root + "root/a");
  EXPECT_EQ(private_path("/usr/include, https://example.org/home/page, .." + root + "work/x, $HOME" + root + "work/x"),
            "");
}

/// Folders stay small enough to find a file by reading their names.
TEST(Files, NoFolderHasMoreThanFortySources) {
  constexpr int most = 40;
  std::map<std::string, int> sources;
  for (const fs::path& file : files_below(NOLI_SOURCE_DIR)) {
    if (is_cpp(file)) ++sources[file.parent_path().lexically_relative(NOLI_SOURCE_DIR).string()];
  }
  EXPECT_GT(sources.size(), 20U);
  for (const auto& [folder, count] : sources) EXPECT_LE(count, most) << folder;
}

TEST(Files, CodeBeginsWithItsLicence) {
  int seen = 0;
  for (const fs::path& file : files_below(NOLI_SOURCE_DIR)) {
    if (!is_code(file)) continue;
    ++seen;
    EXPECT_TRUE(states_licence(read_text(file))) << file;
  }
  EXPECT_GT(seen, 20);
}

TEST(Files, APlaceOfTheLicenceIsJudged) {
  const std::string line = "// SPDX-License-Identifier: Apache-2.0\n";
  EXPECT_TRUE(states_licence(line + "int x;"));
  EXPECT_TRUE(states_licence("#!/bin/sh\n" + line));
  EXPECT_FALSE(states_licence("int x;\n" + line));
  EXPECT_FALSE(states_licence(""));
}

TEST(Files, HeadersAreReadOnce) {
  for (const fs::path& file : files_below(NOLI_SOURCE_DIR)) {
    if (file.extension() != ".h") continue;
    EXPECT_NE(read_text(file).find("\n#pragma once\n"), std::string::npos) << file;
  }
}

/// The README stays short; the manual is in docs/.
TEST(Files, TheReadmeIsAPage) {
  std::istringstream readme(read_text(fs::path(NOLI_SOURCE_DIR) / "README.md"));
  const auto words = std::distance(std::istream_iterator<std::string>(readme), std::istream_iterator<std::string>());
  EXPECT_GT(words, 300);
  EXPECT_LE(words, 900);
}

}  // namespace
}  // namespace noli::repository
