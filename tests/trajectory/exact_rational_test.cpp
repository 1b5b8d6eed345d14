// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/query_csv.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace noli {
namespace {

/// `digits` followed by `count` zeros.
std::string with_zeros(std::string digits, std::size_t count) { return digits.append(count, '0'); }

struct Quotient {
  std::string numerator, denominator;
  double value;
};

const Quotient quotients[] = {
    {"0", "1", 0.0},
    {"-0", "7", -0.0},
    {"0", "-7", 0.0},
    {"+3", "+2", 1.5},
    {"-3", "2", -1.5},
    {"3", "-2", -1.5},
    {"-3", "-2", 1.5},
    {"21", "14", 1.5},
    {"0021", "0014", 1.5},
    {"9007199254740992", "1", 0x1p53},
    {"9007199254740994", "1", 0x1p53 + 2},
    {"-9223372036854775808", "1", -0x1p63},
    {"9223372036854775808", "9223372036854775808", 1.0},
    {"9007199254740993", "9007199254740993", 1.0},
    {with_zeros("1", 22), "1", 1e22},
    {"1", "4611686018427387904", 0x1p-62},
    {with_zeros("123", 400), with_zeros("41", 400), 3.0},
};

TEST(ExactRational, QuotientsThatAreDoubles) {
  for (const auto& [numerator, denominator, expected] : quotients) {
    double value = -1;
    EXPECT_EQ(parse_exact_quotient(numerator, denominator, value), "") << numerator << '/' << denominator;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(expected))
        << numerator << '/' << denominator;
  }
}

struct BadQuotient {
  std::string numerator, denominator, problem;
};
const BadQuotient bad_quotients[] = {
    {"1", "3", "the quotient of '1' and '3' is not exactly a double"},
    {"1", "0", "the denominator is zero"},
    {"0", "0", "the denominator is zero"},
    {"-0", "-0", "the denominator is zero"},
    {"9007199254740993", "1", "the quotient of '9007199254740993' and '1' is not exactly a double"},
    {"-9007199254740993", "4", "the quotient of '-9007199254740993' and '4' is not exactly a double"},
    {with_zeros("1", 23), "1", "the quotient of '" + with_zeros("1", 23) + "' and '1' is not exactly a double"},
    {with_zeros("1", 309), "1", "the quotient of '" + with_zeros("1", 39) + "...' and '1' is not exactly a double"},
    {"", "1", "expected a whole number, found ''"},
    {"1", "", "expected a whole number, found ''"},
    {"-", "1", "expected a whole number, found '-'"},
    {"+-1", "1", "expected a whole number, found '+-1'"},
    {"1.5", "1", "expected a whole number, found '1.5'"},
    {"1e3", "1", "expected a whole number, found '1e3'"},
    {"nan", "1", "expected a whole number, found 'nan'"},
    {"1", "inf", "expected a whole number, found 'inf'"},
    {"0x1", "1", "expected a whole number, found '0x1'"},
    {"1 2", "1", "expected a whole number, found '1 2'"},
};

TEST(ExactRational, AllOthersAreErrors) {
  for (const auto& [numerator, denominator, problem] : bad_quotients) {
    double value = 0;
    EXPECT_EQ(parse_exact_quotient(numerator, denominator, value), problem);
  }
}

TEST(ExactRational, SmallestDouble) {
  double value = 0;
  const std::string denominator = format_exact_quotient(0x1p-1074).substr(2);  // 2^1074 in decimal
  EXPECT_EQ(parse_exact_quotient("1", denominator, value), "");
  EXPECT_EQ(value, 0x1p-1074);
  EXPECT_EQ(parse_exact_quotient("10", denominator + "0", value), "");
  EXPECT_EQ(value, 0x1p-1074);
  EXPECT_EQ(parse_exact_quotient("5", denominator + "0", value).find("the quotient"), 0u) << "half of it is no double";
  EXPECT_EQ(parse_exact_quotient("15", denominator + "0", value).find("the quotient"), 0u) << "nor is one and a half";
}

TEST(ExactRational, LargestDouble) {
  double value = 0;
  const std::string text = format_exact_quotient(std::numeric_limits<double>::max());
  const std::string numerator = text.substr(0, text.find(','));
  EXPECT_EQ(parse_exact_quotient(numerator, "1", value), "");
  EXPECT_EQ(value, std::numeric_limits<double>::max());
  EXPECT_EQ(parse_exact_quotient(numerator + "0", "10", value), "");
  EXPECT_EQ(value, std::numeric_limits<double>::max());
  EXPECT_EQ(parse_exact_quotient(numerator + "0", "5", value).find("the quotient"), 0u) << "twice as much is none";
}

TEST(ExactRational, WrittenInLowestTerms) {
  EXPECT_EQ(format_exact_quotient(0.0), "0,1");
  EXPECT_EQ(format_exact_quotient(-0.0), "-0,1");
  EXPECT_EQ(format_exact_quotient(1.5), "3,2");
  EXPECT_EQ(format_exact_quotient(-0.375), "-3,8");
  EXPECT_EQ(format_exact_quotient(96), "96,1");
  EXPECT_EQ(format_exact_quotient(1e22), with_zeros("1", 22) + ",1");
}

/// Expects that the formatted value is read back bit for bit.
void expect_round_trip(double value) {
  const std::string text = format_exact_quotient(value);
  const std::size_t comma = text.find(',');
  double read = 0;
  ASSERT_EQ(parse_exact_quotient(text.substr(0, comma), text.substr(comma + 1), read), "") << text;
  ASSERT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << text;
}

TEST(ExactRational, RoundTripOfEveryExponent) {
  std::mt19937_64 random(1);
  for (std::uint64_t exponent = 0; exponent < 0x7ff; ++exponent) {
    for (int i = 0; i < 20; ++i) {
      const std::uint64_t significand =
          random() >> 12 >> (random() % 53) << (random() % 2 * 10) & ((std::uint64_t{1} << 52) - 1);
      expect_round_trip(std::bit_cast<double>(random() % 2 << 63 | exponent << 52 | significand));
    }
  }
}

}  // namespace
}  // namespace noli
