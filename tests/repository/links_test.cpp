// SPDX-License-Identifier: Apache-2.0
//
// Checks that every link in a document and every reference in a source leads to something that exists.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> all_matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

bool is_prose(const fs::path& path) { return path.extension() == ".md"; }

/// Targets of links in a document to files of the project that do not exist.
std::vector<std::string> dead_links(const fs::path& document, const std::string& text) {
  std::vector<std::string> dead;
  const std::string prose = std::regex_replace(text, std::regex("`[^`]*`"), "code");
  for (const std::string& target : all_matches(prose, R"(\]\(([^)#\s]+)[^)]*\))")) {
    const bool elsewhere = target.find("://") != std::string::npos || target.starts_with("mailto:");
    if (!elsewhere && !fs::exists(document.parent_path() / target)) dead.push_back(target);
  }
  return dead;
}

/// Sections of docs/ that a source refers to but that do not exist: "docs/contact.md, 4", and (design, "Volume").
std::vector<std::string> dead_sections(const std::string& source, const std::string& contact,
                                       const std::string& design) {
  std::vector<std::string> dead;
  for (const std::string& number : all_matches(source, R"(docs/contact\.md, ([0-9]+))")) {
    if (contact.find("\n## " + number + ". ") == std::string::npos) dead.push_back("contact.md, " + number);
  }
  for (const std::string& name : all_matches(source, R"rx(design,\s+(?://\s+)?"([A-Z][^"/]*)")rx")) {
    if (design.find("# " + name + "\n") == std::string::npos) dead.push_back("design.md, " + name);
  }
  return dead;
}

/// Files and folders that a text names in backticks but that do not exist.
std::vector<std::string> dead_places(const fs::path& root, const std::string& text) {
  std::vector<std::string> dead;
  for (const std::string& place : all_matches(text, R"(`([a-z_]+/[A-Za-z_/.-]*)`)")) {
    if (!fs::exists(root / place)) dead.push_back(place);
  }
  return dead;
}

TEST(Links, OfDocumentsLeadSomewhere) {
  int seen = 0;
  for (const fs::path& file : files_below(NOLI_SOURCE_DIR)) {
    if (!is_prose(file)) continue;
    ++seen;
    EXPECT_EQ(lines(dead_links(file, read_text(file))), "") << file;
  }
  EXPECT_GT(seen, 10);
}

TEST(Links, OfSourcesToTheDesignLeadSomewhere) {
  const fs::path root = NOLI_SOURCE_DIR;
  const std::string contact = read_text(root / "docs/contact.md"), design = read_text(root / "docs/design.md");
  for (const fs::path& file : files_below(root)) {
    if (!is_cpp(file) || file.filename() == "links_test.cpp") continue;
    EXPECT_EQ(lines(dead_sections(read_text(file), contact, design)), "") << file;
  }
}

TEST(Links, NoSourceRefersToWhatIsNotInTheProject) {
  for (const fs::path& file : files_below(NOLI_SOURCE_DIR)) {
    if (!is_cpp(file) || file.filename() == "links_test.cpp") continue;
    EXPECT_TRUE(all_matches(read_text(file), R"((shared/\w+\.md))").empty()) << file;
  }
}

TEST(Links, PlacesOfTheArchitectureAreThere) {
  const fs::path root = NOLI_SOURCE_DIR;
  for (const char* const document : {"docs/architecture.md", "docs/design.md", "docs/contact.md"}) {
    EXPECT_EQ(lines(dead_places(root, read_text(root / document))), "") << document;
  }
}

TEST(Links, FunctionsOfTheArchitectureAreThere) {
  std::string sources;
  for (const fs::path& file : files_below(NOLI_SOURCE_DIR)) {
    if (is_cpp(file) && file.string().find("/tests/") == std::string::npos) sources += read_text(file);
  }
  const std::string text = read_text(fs::path(NOLI_SOURCE_DIR) / "docs/architecture.md");
  const auto functions = all_matches(text, R"(`(?:\w+::)?(\w+)\(\)`)");
  EXPECT_GT(functions.size(), 20U);
  for (const std::string& function : functions)
    EXPECT_NE(sources.find(" " + function + "("), std::string::npos) << function;
}

TEST(Links, DeadOnesAreFound) {
  const TemporaryFolder root;
  write_file(root.path() / "docs/there.md", "");
  EXPECT_EQ(lines(dead_links(root.path() / "docs/a.md",
                             "[a](there.md) [b](gone.md#x) [`c`](https://example.org/x) `d[](int i)`")),
            "gone.md\n");
  EXPECT_EQ(lines(dead_sections("docs/contact.md, 1 and docs/contact.md, 9", "x\n## 1. A\n", "")), "contact.md, 9\n");
  EXPECT_EQ(lines(dead_sections("(design, \"Audit\") (design, \"Gone\")", "", "# Audit\n")), "design.md, Gone\n");
  EXPECT_EQ(lines(dead_places(root.path(), "`docs/there.md` `docs/gone.md`")), "docs/gone.md\n");
}

}  // namespace
}  // namespace noli::repository
