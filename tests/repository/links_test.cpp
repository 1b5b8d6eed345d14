// SPDX-License-Identifier: Apache-2.0
//
// Checks that every link in a document and every reference in a source leads to something that exists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
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

/// The anchor of a heading, as web views of repositories and the documentation make it.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (c == ' ') anchor += '-';
    if (c == '-' || c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0) {
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return anchor;
}

bool has_anchor(const std::string& document, const std::string& anchor) {
  const std::string prose = std::regex_replace(document, std::regex("\n```[^`]*\n```"), "");
  const auto headings = all_matches(prose, R"((?:^|\n)#+ ([^\n]+))");
  return std::ranges::any_of(headings, [&](const std::string& heading) { return anchor_of(heading) == anchor; });
}

/// Targets of links in a document to files of the project, or to headings in them, that do not exist.
std::vector<std::string> dead_links(const fs::path& document, const std::string& text) {
  std::vector<std::string> dead;
  const std::string prose = std::regex_replace(text, std::regex("`[^`]*`"), "code");
  for (const std::string& target : all_matches(prose, R"(\]\(([^)\s]+)[^)]*\))")) {
    if (target.find("://") != std::string::npos || target.starts_with("mailto:")) continue;
    const auto hash = target.find('#');
    const std::string file = target.substr(0, hash);
    const bool there = file.empty() || fs::exists(document.parent_path() / file);
    if (!there) dead.push_back(file);
    if (!there || hash == std::string::npos) continue;
    if (!has_anchor(file.empty() ? text : read_text(document.parent_path() / file), target.substr(hash + 1))) {
      dead.push_back(target);
    }
  }
  return dead;
}

/// The documents whose sections sources refer to.
struct Documents {
  std::string contact, design, format, theory;
};

/// Sections that a source refers to but that do not exist: "docs/contact.md, 4", "proofs/FORMAT.md, sections 2 to 4",
/// "theory.md, T5", and (design, "Volume"). Counts those with a number.
std::vector<std::string> dead_sections(const std::string& source, const Documents& documents, std::size_t& named) {
  struct Reference {
    const char* pattern;
    const std::string& document;
    const char* name;
  };
  const Reference references[] = {
      {R"(docs/contact\.md, (?:section )?([0-9]+))", documents.contact, "contact.md"},
      {R"(docs/contact\.md, [0-9]+ and ([0-9]+))", documents.contact, "contact.md"},
      {R"(proofs/FORMAT\.md,\s+(?://\s+)?sections?\s+(?://\s+)?([0-9]+))", documents.format, "FORMAT.md"},
      {R"(proofs/FORMAT\.md,\s+(?://\s+)?sections [0-9]+ (?:and|to) ([0-9]+))", documents.format, "FORMAT.md"},
      {R"(theory\.md, ([A-Z][0-9]+))", documents.theory, "theory.md"}};
  std::vector<std::string> dead;
  for (const auto& [pattern, document, document_name] : references) {
    for (const std::string& section : all_matches(source, pattern)) {
      ++named;
      if (document.find("\n## " + section + ". ") == std::string::npos) {
        dead.push_back(document_name + (", " + section));
      }
    }
  }
  for (const std::string& name : all_matches(source, R"rx(design,\s+(?://\s+)?"([A-Z][^"/]*)")rx")) {
    if (documents.design.find("# " + name + "\n") == std::string::npos) dead.push_back("design.md, " + name);
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

/// Sources that comments in a file of this folder name but that do not exist: by their path in the project, the last
/// part of it, or, if they are in the same folder, by name. Counts all that are named.
std::vector<std::string> dead_sources(const std::string& folder, const std::string& source,
                                      const std::set<std::string>& sources, std::size_t& named) {
  std::vector<std::string> dead;
  for (const std::string& comment : all_matches(source, R"(//([^\n]*))")) {
    for (const std::string& name : all_matches(comment, R"((?:^|[^\w/.<*-])([A-Za-z_][\w/]*\.(?:h|cpp))\b)")) {
      const auto is_it = [&name](const std::string& path) { return ("/" + path).ends_with("/" + name); };
      const bool has_path = name.find('/') != std::string::npos;
      ++named;
      if (has_path ? std::ranges::none_of(sources, is_it) : !sources.contains(folder + "/" + name))
        dead.push_back(name);
    }
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

TEST(Links, OfSourcesToSectionsLeadSomewhere) {
  const fs::path root = NOLI_SOURCE_DIR;
  const Documents documents{read_text(root / "docs/contact.md"), read_text(root / "docs/design.md"),
                            read_text(root / "proofs/FORMAT.md"), read_text(root / "proofs/theory.md")};
  std::size_t named = 0;
  for (const fs::path& file : files_below(root)) {
    if (!is_cpp(file) || file.filename() == "links_test.cpp") continue;
    EXPECT_EQ(lines(dead_sections(read_text(file), documents, named)), "") << file;
  }
  EXPECT_GT(named, 40U);
}

TEST(Links, OfCommentsToSourcesLeadSomewhere) {
  const fs::path root = NOLI_SOURCE_DIR;
  std::set<std::string> sources;
  for (const fs::path& file : files_below(root)) {
    if (is_cpp(file)) sources.insert(file.lexically_relative(root).string());
  }
  std::size_t named = 0;
  for (const fs::path& file : files_below(root)) {
    if (!is_cpp(file) || file.filename() == "links_test.cpp") continue;
    const std::string folder = file.parent_path().lexically_relative(root).string();
    auto dead = dead_sources(folder, read_text(file), sources, named);
    std::erase(dead, "vtkCellType.h");  // of VTK
    EXPECT_EQ(lines(dead), "") << file;
  }
  EXPECT_GT(named, 200U);
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
  EXPECT_EQ(lines(dead_links(root.path() / "docs/a.md", "# A B\n[a](#a-b) [b](#b) [c](there.md#a)")),
            "#b\nthere.md#a\n");
  std::size_t numbers = 0;
  const Documents documents{"x\n## 1. A\n", "# Audit\n", "x\n## 2. B\n## 3. C\n", "x\n## T5. D\n"};
  EXPECT_EQ(lines(dead_sections("docs/contact.md, 1 and docs/contact.md, 9", documents, numbers)), "contact.md, 9\n");
  EXPECT_EQ(lines(dead_sections("(design, \"Audit\") (design, \"Gone\")", documents, numbers)), "design.md, Gone\n");
  EXPECT_EQ(
      lines(dead_sections("proofs/FORMAT.md, sections 2 and 3; proofs/FORMAT.md, sections 2 to 4", documents, numbers)),
      "FORMAT.md, 4\n");
  EXPECT_EQ(lines(dead_sections("proofs/FORMAT.md,\n// section 2; proofs/FORMAT.md, section 5", documents, numbers)),
            "FORMAT.md, 5\n");
  EXPECT_EQ(lines(dead_sections("proofs/theory.md, T5; theory.md, T6", documents, numbers)), "theory.md, T6\n");
  std::size_t named = 0;
  const auto dead = [&](const std::string& folder) {
    return lines(
        dead_sources(folder, "int i;  // see there.h, b/there.h, c/there.h, gone.cpp", {"a/b/there.h"}, named));
  };
  EXPECT_EQ(dead("a/b"), "c/there.h\ngone.cpp\n");
  EXPECT_EQ(dead("a"), "there.h\nc/there.h\ngone.cpp\n");
  EXPECT_EQ(named, 8U);
  EXPECT_EQ(lines(dead_places(root.path(), "`docs/there.md` `docs/gone.md`")), "docs/gone.md\n");
}

}  // namespace
}  // namespace noli::repository
