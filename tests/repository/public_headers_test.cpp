// SPDX-License-Identifier: Apache-2.0
//
// Checks that the public headers stand on their own. The target noli_public_headers, which sees no other header of the
// project, tests that they compile, each alone and all together.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "layers.h"
#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> public_headers() { return files_below(fs::path(NOLI_SOURCE_DIR) / "include"); }

bool is_of_standard_library(const std::string& target) {
  return target.find_first_of("./") == std::string::npos || target == "stddef.h" || target == "stdint.h";
}

/// The only headers that a public header may include besides other public headers and the standard library.
bool is_of_cgal(const std::string& target) { return target.starts_with("CGAL/") || target == "mpfr.h"; }

TEST(PublicHeaders, AreFew) {
  EXPECT_GE(public_headers().size(), 12U);
  EXPECT_LE(public_headers().size(), 18U);
}

TEST(PublicHeaders, IncludeNothingInside) {
  for (const fs::path& header : public_headers()) {
    for (const Include& include : includes(read_text(header))) {
      const bool is_public =
          include.target.starts_with("noli/") && fs::exists(fs::path(NOLI_SOURCE_DIR) / "include" / include.target);
      EXPECT_TRUE(is_public || is_of_standard_library(include.target) ||
                  (header.filename() == "cgal.h" && is_of_cgal(include.target)))
          << header << ':' << include.line << ": " << include.target;
    }
  }
}

/// Each public header explains what it offers before it declares it.
TEST(PublicHeaders, BeginWithTheirManual) {
  for (const fs::path& header : public_headers()) {
    const std::string text = read_text(header);
    const std::string manual = text.substr(0, text.find("#pragma once"));
    EXPECT_GE(manual.size(), 100U) << header;
    if (header.extension() == ".h" && header.filename() != "ccd_plugin.h") {
      EXPECT_NE(manual.find("hread"), std::string::npos) << header << " says nothing of threads";
      EXPECT_NE(text.find("namespace noli {"), std::string::npos) << header;
    }
  }
}

}  // namespace
}  // namespace noli::repository
