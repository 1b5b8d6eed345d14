// SPDX-License-Identifier: Apache-2.0
//
// Checks that the constants of the floating-point filters are those of the theorems in proofs/gappa.
//
// Both are compared as text, so that constants in a .cpp can be checked too. `Definition X := E.` in Constants.v, after
// a comment that is the path of a source, requires `constexpr double X = E;` in that source, where 0x1pk stands for
// `bpow radix2 (k)`.
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

struct ProvedConstant {
  std::string file, name, value;
};

std::vector<ProvedConstant> proved_constants(const std::string& theory) {
  static const std::regex source(R"(\(\* (\S+) \*\))"), definition(R"(Definition (\w+) := (.*)\.)");
  static const std::regex power(R"(bpow radix2 \((-?\d+)\))");
  std::vector<ProvedConstant> found;
  std::istringstream lines(theory);
  std::string file;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, source)) file = match[1];
    if (std::regex_match(line, match, definition)) {
      found.push_back({file, match[1], std::regex_replace(match[2].str(), power, "0x1p$1")});
    }
  }
  return found;
}

/// The values of the constant in a source.
std::vector<std::string> values_in(const std::string& code, const std::string& name) {
  const std::regex pattern("\\bconstexpr double " + name + " = ([^;]*);");
  std::vector<std::string> values;
  for (std::sregex_iterator i(code.begin(), code.end(), pattern), end; i != end; ++i) values.push_back((*i)[1]);
  return values;
}

TEST(ProvedConstants, AreThoseOfTheCode) {
  const fs::path root = NOLI_SOURCE_DIR;
  const auto constants = proved_constants(read_text(root / "proofs" / "gappa" / "Constants.v"));
  EXPECT_GE(constants.size(), 16U);
  for (const auto& c : constants) {
    EXPECT_EQ(values_in(read_text(root / c.file), c.name), std::vector{c.value}) << c.file << ": " << c.name;
  }
}

TEST(ProvedConstants, AreReadFromTheories) {
  const auto constants = proved_constants(
      "(* SPDX-License-Identifier: X *)\n(* a/b.h *)\nDefinition x := 2 * (3 + bpow radix2 (-53)).\n"
      "(* c.h *)\nDefinition y := bpow radix2 (4).\n");
  ASSERT_EQ(constants.size(), 2U);
  EXPECT_EQ(constants[0].file + " " + constants[0].name + " " + constants[0].value, "a/b.h x 2 * (3 + 0x1p-53)");
  EXPECT_EQ(constants[1].file + " " + constants[1].name + " " + constants[1].value, "c.h y 0x1p4");
}

TEST(ProvedConstants, AreReadFromCode) {
  const std::string code = "constexpr double x = 16;  // units\nconstexpr double xy = 2;\nconstexpr double z = 0x1p-3;";
  EXPECT_EQ(values_in(code, "x"), std::vector<std::string>{"16"});
  EXPECT_EQ(values_in(code, "z"), std::vector<std::string>{"0x1p-3"});
  EXPECT_TRUE(values_in(code, "y").empty());
}

}  // namespace
}  // namespace noli::repository
