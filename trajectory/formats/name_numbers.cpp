// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/name_numbers.h"

#include <utility>

#include "trajectory/text.h"

namespace noli {
namespace {

/// Stands for a number in a pattern; no path contains it.
constexpr char number_sign = '\0';
/// Exponents with more digits than these are text: nobody writes them.
constexpr std::size_t most_exponent_digits = 6;

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

NameNumber number(bool negative, std::string_view whole, std::string_view fraction, std::int64_t exponent) {
  NameNumber result{negative, exponent + static_cast<std::int64_t>(whole.size()), std::string(whole)};
  result.digits += fraction;
  const std::size_t first = result.digits.find_first_not_of('0');
  if (first == std::string::npos) return {};
  result.digits.erase(0, first);
  result.exponent -= static_cast<std::int64_t>(first);
  result.digits.erase(result.digits.find_last_not_of('0') + 1);
  return result;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  NumberedName parse() {
    while (at_ < text_.size()) {
      if (begins_number()) {
        read_number();
      } else {
        name_.pattern += text_[at_++];
      }
    }
    return std::move(name_);
  }

 private:
  bool digit_at(std::size_t i) const { return i < text_.size() && is_digit(text_[i]); }

  bool begins_with_sign() const {
    if (text_[at_] != '-' || !digit_at(at_ + 1)) return false;
    return at_ == 0 || text_[at_ - 1] == '_' || text_[at_ - 1] == '=' || text_[at_ - 1] == '/';
  }
  bool begins_number() const { return digit_at(at_) || begins_with_sign(); }

  std::string_view read_digits() {
    const std::size_t begin = at_;
    while (digit_at(at_)) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// At the point of `12.5`, and not of `1.2.5`, the extension, or a word.
  bool at_decimal_point(std::size_t begin) const {
    if (at_ >= text_.size() || text_[at_] != '.' || !digit_at(at_ + 1)) return false;
    std::size_t end = at_ + 1;
    while (digit_at(end)) ++end;
    const bool another_before = begin > 1 && text_[begin - 1] == '.' && is_digit(text_[begin - 2]);
    const bool another_after = end < text_.size() && text_[end] == '.' && digit_at(end + 1);
    return !another_before && !another_after;
  }

  /// Of `1e-05`: with a sign alone, since `1e05` may be a word.
  std::int64_t read_exponent() {
    if (at_ + 2 >= text_.size() || (text_[at_] | 0x20) != 'e') return 0;
    if ((text_[at_ + 1] != '-' && text_[at_ + 1] != '+') || !digit_at(at_ + 2)) return 0;
    std::size_t end = at_ + 2;
    while (digit_at(end)) ++end;
    if (end - at_ - 2 > most_exponent_digits) return 0;
    std::int64_t exponent = 0;
    parse_number(text_.substr(at_ + 2, end - at_ - 2), exponent);
    if (text_[at_ + 1] == '-') exponent = -exponent;
    at_ = end;
    name_.has_exponent = true;
    return exponent;
  }

  void read_number() {
    const bool negative = text_[at_] == '-';
    if (negative) ++at_;
    const std::size_t begin = at_;
    const std::string_view whole = read_digits();
    std::string_view fraction;
    if (at_decimal_point(begin)) {
      ++at_;
      fraction = read_digits();
    }
    const std::int64_t exponent = read_exponent();
    name_.pattern += number_sign;
    name_.decimals.push_back(number(negative, whole, fraction, exponent));
    name_.fractions.emplace_back(fraction);
    name_.integers.push_back(number(negative, whole, {}, 0));
    // Of whole numbers and those with a fraction in one family, 1 and 1.5, the former have an empty second number.
    name_.integers.push_back(fraction.empty() ? NameNumber{} : number(negative, fraction, {}, 0));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  NumberedName name_;
};

}  // namespace

std::strong_ordering NameNumber::operator<=>(const NameNumber& other) const {
  const auto size = [](const NameNumber& a, const NameNumber& b) {
    if (a.digits.empty() || b.digits.empty()) return a.digits.size() <=> b.digits.size();
    if (a.exponent != b.exponent) return a.exponent <=> b.exponent;
    return a.digits.compare(b.digits) <=> 0;
  };
  if (negative != other.negative) return negative ? std::strong_ordering::less : std::strong_ordering::greater;
  return negative ? size(other, *this) : size(*this, other);
}

NumberedName numbers_of_name(const std::filesystem::path& path) {
  const std::string text = (path.parent_path() / path.stem()).lexically_normal().string();
  return Parser(text).parse();
}

}  // namespace noli
