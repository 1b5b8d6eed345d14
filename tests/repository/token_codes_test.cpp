// SPDX-License-Identifier: Apache-2.0
//
// Checks that the codes of tokens are those of the table in proofs/FORMAT.md, section 4.
//
// Prover, checker and tests in Python may not share an enum, so each has a TokenCode. All are compared as text, except
// proofs/coq/driver/main.ml, which has the bytes themselves. A row
// of the table with several codes, which have to be consecutive, is two entries: NAME, and last_NAME for its last code.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

/// The code of each name; -1 without one.
using Codes = std::map<std::string, int>;

/// What is in the text between two others, empty unless both are there.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size(), to = text.find(end, from);
  return to == std::string::npos ? "" : text.substr(from, to - from);
}

/// Those of the rows "| CODE, CODE... | token | NAME | ...".
Codes codes_of_table(const std::string& document) {
  static const std::regex row(R"(\| ([0-9a-f]{2}(?:, [0-9a-f]{2})*) \| [^|]* \| (\w+) \|.*)"), code("[0-9a-f]{2}");
  Codes found;
  std::istringstream lines(between(document, "## 4. Tokens as bytes\n", "\n## "));
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    const std::string codes = match[1], name = match[2];
    const int first = std::stoi(codes, nullptr, 16);
    EXPECT_TRUE(found.emplace(name, first).second) << line;
    int next = first;
    for (std::sregex_iterator i(codes.begin(), codes.end(), code), end; i != end; ++i, ++next) {
      EXPECT_EQ(std::stoi(i->str(), nullptr, 16), next) << line;
    }
    if (next - first > 1) found.emplace("last_" + name, next - 1);
  }
  return found;
}

/// The entries of an enumeration in C++ or Python.
Codes codes_of_enumeration(const std::string& body) {
  static const std::regex comment("(//|#).*"), entry(R"((\w+)(?: = 0x([0-9a-fA-F]{2})\b)?)");
  const std::string text = std::regex_replace(body, comment, "");
  Codes found;
  for (std::sregex_iterator i(text.begin(), text.end(), entry), end; i != end; ++i) {
    const int code = (*i)[2].matched ? std::stoi((*i)[2], nullptr, 16) : -1;
    EXPECT_TRUE(found.emplace((*i)[1], code).second) << (*i)[1];
  }
  return found;
}

Codes codes_of_cpp(const std::string& code) {
  return codes_of_enumeration(between(code, "enum class TokenCode : std::uint8_t {\n", "};"));
}

Codes codes_of_python(const std::string& code) {
  return codes_of_enumeration(between(code, "class TokenCode(enum.IntEnum):\n", "\n\n"));
}

TEST(TokenCodes, AreThoseOfTheFormat) {
  const fs::path root = NOLI_SOURCE_DIR;
  const Codes table = codes_of_table(read_text(root / "proofs" / "FORMAT.md"));
  EXPECT_GE(table.size(), 16U);
  EXPECT_EQ(codes_of_cpp(read_text(root / "proofs" / "prover" / "tokens" / "tokens.h")), table);
  EXPECT_EQ(codes_of_cpp(read_text(root / "proofs" / "checker" / "obligations.h")), table);
  EXPECT_EQ(codes_of_python(read_text(root / "tests" / "proofs" / "proof_bytes.py")), table);
}

TEST(TokenCodes, AreReadFromTheTable) {
  const std::string document =
      "| 07 | U | above | |\n## 4. Tokens as bytes\n\n| first byte | token | name | follows |\n|---|---|---|---|\n"
      "| 08, 09, 0a | S | axis | |\n| 10 | S with n | direction | `u32` |\n\n## 5. Others\n| 30 | W | ring | |\n";
  EXPECT_EQ(codes_of_table(document), (Codes{{"axis", 8}, {"last_axis", 10}, {"direction", 16}}));
}

TEST(TokenCodes, AreReadFromCode) {
  const Codes codes = {{"axis", 8}, {"last_axis", 13}, {"ring", -1}};
  EXPECT_EQ(codes_of_cpp("enum class Other { x };\nenum class TokenCode : std::uint8_t {\n"
                         "  axis = 0x08,  ///< S = 1\n  last_axis = 0x0d,\n  ring\n};\nint y = 0x30;\n"),
            codes);
  EXPECT_EQ(codes_of_python("class TokenCode(enum.IntEnum):\n    # S = 1\n    axis = 0x08\n    last_axis = 0x0D\n"
                            "    ring\n\n\nring = 0x30\n"),
            codes);
  EXPECT_TRUE(codes_of_cpp("enum TokenCode { axis = 0x08 };").empty());
}

}  // namespace
}  // namespace noli::repository
