// SPDX-License-Identifier: Apache-2.0
#include "trajectory/text.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "support.h"

namespace noli {
namespace {

std::vector<std::string> all_lines(std::string_view text, std::size_t first = 1) {
  std::vector<std::string> result;
  Lines lines(text, first);
  for (std::string_view line; lines.next(line);)
    result.push_back(std::to_string(lines.number()) + ":" + std::string(line));
  return result;
}

TEST(Text, Lines) {
  using Strings = std::vector<std::string>;
  EXPECT_EQ(all_lines(""), Strings{});
  EXPECT_EQ(all_lines("a"), (Strings{"1:a"}));
  EXPECT_EQ(all_lines("a\n\r\nb\r\n", 7), (Strings{"7:a", "8:", "9:b"}));
  EXPECT_EQ(all_lines("\n\n"), (Strings{"1:", "2:"}));
  EXPECT_EQ(all_lines("a\rb\r\r\n"), (Strings{"1:a\rb\r"})) << "only the last CR belongs to the line end";
}

TEST(Text, Words) {
  Words words("  one\ttwo \t 3");
  EXPECT_FALSE(words.at_end());
  EXPECT_EQ(words.next(), "one");
  EXPECT_EQ(words.next(), "two");
  EXPECT_EQ(words.next(), "3");
  EXPECT_TRUE(words.at_end());
  EXPECT_EQ(words.next(), "");
  EXPECT_TRUE(Words(" \t").at_end());
}

TEST(Text, NumbersAreTheWholeWord) {
  std::int32_t i = 0;
  EXPECT_EQ(parse_number("-12", i), std::errc{});
  EXPECT_EQ(i, -12);
  EXPECT_EQ(parse_number("+12", i), std::errc{});
  EXPECT_EQ(i, 12);
  for (const char* word : {"", "+", "-", "+-1", "++1", "1 ", "1x", " 1", "1.0", "0x1"}) {
    EXPECT_EQ(parse_number(word, i), std::errc::invalid_argument) << word;
  }
  EXPECT_EQ(parse_number("2147483648", i), std::errc::result_out_of_range);
}

TEST(Text, RealNumbersAreRoundedCorrectly) {
  double x = 0;
  EXPECT_EQ(parse_finite("1.7976931348623158e308", x), "");
  EXPECT_EQ(x, std::numeric_limits<double>::max());
  EXPECT_EQ(parse_finite("9007199254740993", x), "");
  EXPECT_EQ(x, 0x1p53) << "half-way, to even";
  EXPECT_EQ(parse_finite("9007199254740993.00000000000000000000000000001", x), "");
  EXPECT_EQ(x, 0x1p53 + 2) << "a little over half-way";
  EXPECT_EQ(parse_finite("-0", x), "");
  EXPECT_TRUE(x == 0 && std::signbit(x));
  float y = 0;
  EXPECT_EQ(parse_finite("16777217.0000001", y), "");
  EXPECT_EQ(y, 16777218.0f);
}

TEST(Text, RealNumbersThatAreNone) {
  double x = 0;
  EXPECT_EQ(parse_finite("1.7976931348623159e308", x), "'1.7976931348623159e308' is outside the range of double");
  EXPECT_EQ(parse_finite("2.4703282292062327e-324", x), "'2.4703282292062327e-324' is outside the range of double");
  EXPECT_EQ(parse_finite("", x), "expected a number, found ''");
  EXPECT_EQ(parse_finite("1e", x), "expected a number, found '1e'");
  EXPECT_EQ(parse_finite("infinity", x), "expected a finite number, found 'infinity'");
  EXPECT_EQ(parse_finite("NaN", x), "expected a finite number, found 'NaN'");
}

TEST(Text, QuotedWordsFitALine) {
  EXPECT_EQ(in_quotes("a b\n"), "'a b?'");
  EXPECT_EQ(in_quotes(std::string(40, 'x')), "'" + std::string(40, 'x') + "'");
  EXPECT_EQ(in_quotes(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(Text, OneLine) {
  EXPECT_EQ(on_one_line("a b/\xc3\xa9.ply"), "a b/\xc3\xa9.ply");
  EXPECT_EQ(on_one_line(std::string("\n\t\r\0\x1b\x7f", 6)), "\\n\\t\\x0d\\x00\\x1b\\x7f");
  EXPECT_STREQ(InputError("a\nb", "line 1", "wrong").what(), "a\\nb: line 1: wrong");
}

TEST(Text, WholeFiles) {
  const test::TemporaryFolder folder;
  const std::string content(100000, '\0');
  EXPECT_EQ(read_whole_file(folder.write("zeros", content)), content);
  if (std::filesystem::exists("/dev/null")) {
    EXPECT_EQ(testing::input_error([] { read_whole_file("/dev/null"); }),
              "/dev/null: is a device, expected a file or a pipe");
  } else {
    std::puts("skipped: a device, there is no /dev/null");
  }
}

TEST(EscapedMarkup, SaysWhatXmlTakes) {
  EXPECT_EQ(escaped_markup("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(escaped_markup(std::string("a\x01\x1f\0b\tc\n", 8)), "ab\tc\n");
  EXPECT_EQ(escaped_markup("\xc3\xa9"), "\xc3\xa9");
}

}  // namespace
}  // namespace noli
