// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/text_digits.h"

#include <fmt/format.h>

#include <algorithm>

#include "trajectory/text.h"

namespace noli {

void TextDigits::add(std::string_view word) {
  std::size_t whole = 0, fraction = 0, zeros = 0, significant = 0;
  bool point = false;
  std::size_t at = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
  for (; at < word.size(); ++at) {
    const char c = word[at];
    if (c == '.' && !point) {
      point = true;
    } else if (c >= '0' && c <= '9') {
      ++(point ? fraction : whole);
      ++(significant > 0 || c != '0' ? significant : zeros);
    } else {
      break;
    }
  }
  if (whole + fraction == 0) return;
  int exponent = 0;
  if (at < word.size() && ((word[at] | 0x20) != 'e' || parse_number(word.substr(at + 1), exponent) != std::errc{}))
    return;
  any_ = true;
  const int behind = static_cast<int>(fraction) - exponent;
  decimals_ = std::max(decimals_, static_cast<std::size_t>(std::max(behind, 0)));
  if (behind > 0) least_decimals_ = std::min(least_decimals_.value_or(decimals_), static_cast<std::size_t>(behind));
  if (significant == 0) return;
  digits_ = std::max(digits_, significant);
  const int first = static_cast<int>(whole) - static_cast<int>(zeros) - 1 + exponent;
  largest_ = std::max(largest_.value_or(first), first);
}

std::optional<int> TextDigits::unit() const {
  if (!any_) return std::nullopt;
  // 0.000001 beside 4: no notation with so few digits writes that, but a fixed number of decimals.
  const bool fixed = least_decimals_ && *least_decimals_ == decimals_ && digits_ < decimals_;
  if (!largest_ || fixed) return -static_cast<int>(decimals_);
  return *largest_ - static_cast<int>(digits_) + 1;
}

std::string TextDigits::words() const {
  return fmt::format("text with {} digit{}, {} decimal{}", digits_, digits_ == 1 ? "" : "s", decimals_,
                     decimals_ == 1 ? "" : "s");
}

}  // namespace noli
