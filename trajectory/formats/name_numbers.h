// SPDX-License-Identifier: Apache-2.0
//
// The numbers in the names of files: found, kept without rounding, compared. frame_order.h says what counts as one.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace noli {

/// 0.DIGITS 10^exponent, with a sign. DIGITS neither begins nor ends with 0; none: the number is zero.
struct NameNumber {
  bool negative = false;
  std::int64_t exponent = 0;
  std::string digits;

  std::strong_ordering operator<=>(const NameNumber& other) const;
  bool operator==(const NameNumber& other) const = default;
};

struct NumberedName {
  std::string pattern;                 ///< the name with each number replaced
  std::vector<NameNumber> decimals;    ///< `12.5` is one number
  std::vector<NameNumber> integers;    ///< `12.5` is two numbers; the same pattern
  std::vector<std::string> fractions;  ///< digits behind a point that may be decimal
  bool has_exponent = false;           ///< 1e-05: there is only one way to read it
};

/// Of the path as it is given, without the extension.
NumberedName numbers_of_name(const std::filesystem::path& path);

}  // namespace noli
