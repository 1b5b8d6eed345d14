// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "audit/ccd/audit_report.h"

namespace noli::audit {
namespace {

std::string lines(int from, int to) {
  std::string text;
  for (int i = from; i <= to; ++i) text += fmt::format("line {}\n", i);
  return text;
}

TEST(SaidText, OneLineStaysOne) {
  EXPECT_EQ(said_text("lib", "no memory\n"), "lib wrote to its standard error: no memory\n");
}

TEST(SaidText, AFewLinesAreShownWhole) {
  EXPECT_EQ(said_text("lib", "one\n\x1b[31mtwo"), "lib wrote to its standard error:\n  one\n  \\x1b[31mtwo\n");
}

TEST(SaidText, OfManyTheLastAreShown) {
  const std::string text = said_text("lib", lines(1, 100));
  EXPECT_EQ(text.find("  line 80\n"), std::string::npos);
  EXPECT_NE(text.find("100 lines (--json has them); of these:\n  line 81\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  line 100\n"), std::string::npos);
}

TEST(SaidText, ASanitizersErrorIsWhereItBegins) {
  const std::string text = said_text("lib", lines(1, 50) + "==7==ERROR: AddressSanitizer: heap\n" + lines(51, 100));
  EXPECT_NE(text.find("of these:\n  ==7==ERROR: AddressSanitizer: heap\n  line 51\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  line 69\n"), std::string::npos);
  EXPECT_EQ(text.find("  line 70\n"), std::string::npos);
}

}  // namespace
}  // namespace noli::audit
