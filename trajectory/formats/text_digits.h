// SPDX-License-Identifier: Apache-2.0
//
// How finely decimal text gives coordinates: what rounding to that text may have moved.
//
// Notation
//   digits     of one number: from its first digit that is not 0 to its last one, zeros at the end included; the most
//              of all numbers is what the text is said to have
//   decimals   of one number: digits behind the point, where an exponent moves it; the most of all numbers
//   unit       10^k. The place of the last of so many digits in the number of the largest magnitude: with %.6f 10^-6;
//              with %g or %e that of the coarsest coordinate. Where all numbers with decimals have as many, and more
//              than there are digits (0.000001 beside 4), it is the place of the last decimal
//
// What this does not do: it cannot know whether numbers were rounded. 0.5 may be a half, or 0.46 with one decimal.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace noli {

class TextDigits {
 public:
  /// Takes one word of a file. Words that are no numbers count nothing.
  void add(std::string_view word);

  std::size_t digits() const { return digits_; }
  std::size_t decimals() const { return decimals_; }
  /// k of the unit 10^k; nothing before the first number.
  std::optional<int> unit() const;
  /// "text with 9 digits, 6 decimals"
  std::string words() const;

 private:
  std::size_t digits_ = 0, decimals_ = 0;
  std::optional<std::size_t> least_decimals_;  ///< of the numbers that have any
  std::optional<int> largest_;                 ///< k of the first digit of the largest number
  bool any_ = false;
};

/// So many digits tell every float64, or float32, from all others: text that has them need not have been rounded.
inline constexpr std::size_t digits_of_float64 = 17, digits_of_float32 = 9;

}  // namespace noli
