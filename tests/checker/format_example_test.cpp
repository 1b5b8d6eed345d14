// SPDX-License-Identifier: Apache-2.0
//
// Tests that the worked example of proofs/FORMAT.md has the bytes of the test's writer, and is accepted.
#include <regex>

#include "support.h"

namespace noli::checker::test {
namespace {

/// The bytes of the lines "    OFFSET  BYTES  meaning". A wrong offset is a test failure.
std::string example_bytes() {
  static const std::regex line_of_bytes(R"(    ([0-9a-f]{4})  (([0-9a-f]{2} ?)+)( .*)?)");
  std::ifstream document(fs::path(NOLI_SOURCE_DIR) / "proofs" / "FORMAT.md");
  std::string result;
  for (std::string line; std::getline(document, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, line_of_bytes)) continue;
    EXPECT_EQ(std::stoul(match[1], nullptr, 16), result.size()) << line;
    std::istringstream words(match[2]);
    for (std::string word; words >> word;) result += static_cast<char>(std::stoul(word, nullptr, 16));
  }
  return result;
}

TEST(FormatDocument, ItsExampleIsAccepted) {
  const std::string written = block_file("PROF", two_edges().groups());
  EXPECT_EQ(example_bytes(), written);
  EXPECT_ACCEPTED(two_edges().check(example_bytes()));
}

}  // namespace
}  // namespace noli::checker::test
