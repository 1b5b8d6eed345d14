// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_look.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <initializer_list>

namespace noli {
namespace {

TextDigits of(std::initializer_list<const char*> words) {
  TextDigits digits;
  for (const char* const word : words) digits.add(word);
  return digits;
}

TEST(TextDigits, FixedDecimals) {
  const TextDigits digits = of({"123.456789", "-0.000123", "0.000000", "1.500000"});
  EXPECT_EQ(digits.digits(), 9u);
  EXPECT_EQ(digits.decimals(), 6u);
  EXPECT_EQ(digits.unit(), -6);
  EXPECT_EQ(digits.text(), "text with 9 digits, 6 decimals");
}

TEST(TextDigits, BelowOneTheUnitStaysThatOfTheDecimals) {
  EXPECT_EQ(of({"0.012345", "-0.000007"}).unit(), -6);
  EXPECT_EQ(of({"0.000000"}).unit(), -6);
  EXPECT_EQ(of({".5"}).unit(), -1);
}

TEST(TextDigits, SignificantDigitsAreCoarsestAtTheLargestNumber) {
  // Output of %g with 6 digits: the last digit of 1234.56 stands for 0.01, however fine the small numbers are.
  const TextDigits digits = of({"1234.56", "0.00123456", "0", "7", "1e-05"});
  EXPECT_EQ(digits.digits(), 6u);
  EXPECT_EQ(digits.unit(), -2);
}

TEST(TextDigits, Exponents) {
  EXPECT_EQ(of({"1.234560e+03"}).unit(), -3);
  EXPECT_EQ(of({"1.234560E-03", "0.000000e+00"}).unit(), -9);
  EXPECT_EQ(of({"1.234560e-03"}).decimals(), 9u);
  EXPECT_EQ(of({"12e3"}).unit(), 3);
}

TEST(TextDigits, WholeNumbers) {
  EXPECT_EQ(of({"10", "-250"}).unit(), 0);
  EXPECT_EQ(of({"1"}).text(), "text with 1 digit, 0 decimals");
}

TEST(TextDigits, WhatIsNoNumberCountsNothing) {
  const TextDigits digits = of({"", "-", ".", "#", "nan", "inf", "1.5x", "2.25e", "e5"});
  EXPECT_EQ(digits.unit(), std::nullopt);
  EXPECT_EQ(digits.digits(), 0u);
}

TEST(TextDigits, SeventeenDigitsOfADouble) {
  EXPECT_EQ(of({fmt::format("{:.17g}", 0.1).c_str()}).digits(), digits_of_float64);
  EXPECT_LT(of({fmt::format("{:.16g}", 0.3).c_str()}).digits(), digits_of_float64);
}

}  // namespace
}  // namespace noli
