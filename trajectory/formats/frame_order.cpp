// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_order.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

// --- The numbers in a name: found, kept without rounding, compared --------------------------------------------------

/// 0.DIGITS 10^exponent, with a sign. DIGITS neither begins nor ends with 0; it is empty if the number is zero.
struct NameNumber {
  bool negative = false;
  std::int64_t exponent = 0;
  std::string digits;

  bool operator==(const NameNumber& other) const = default;
  std::strong_ordering operator<=>(const NameNumber& other) const {
    const auto size = [](const NameNumber& a, const NameNumber& b) {
      if (a.digits.empty() || b.digits.empty()) return a.digits.size() <=> b.digits.size();
      if (a.exponent != b.exponent) return a.exponent <=> b.exponent;
      return a.digits.compare(b.digits) <=> 0;
    };
    if (negative != other.negative) return negative ? std::strong_ordering::less : std::strong_ordering::greater;
    return negative ? size(other, *this) : size(*this, other);
  }
};

struct NumberedName {
  std::string pattern;                 ///< the name with each number replaced
  std::vector<NameNumber> decimals;    ///< `12.5` is one number
  std::vector<NameNumber> integers;    ///< `12.5` is two numbers; the same pattern
  std::vector<std::string> fractions;  ///< digits after a point that may be decimal
  bool has_exponent = false;           ///< as in 1e-05, which can be read in only one way
};

/// Stands for a number in a pattern; no path contains it.
constexpr char number_sign = '\0';
/// Exponents with more digits count as text.
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

  /// Whether this is the point of a number such as `12.5`, and not of `1.2.5`, the extension, or a word.
  bool at_decimal_point(std::size_t begin) const {
    if (at_ >= text_.size() || text_[at_] != '.' || !digit_at(at_ + 1)) return false;
    std::size_t end = at_ + 1;
    while (digit_at(end)) ++end;
    const bool another_before = begin > 1 && text_[begin - 1] == '.' && is_digit(text_[begin - 2]);
    const bool another_after = end < text_.size() && text_[end] == '.' && digit_at(end + 1);
    return !another_before && !another_after;
  }

  /// The exponent of `1e-05`. It needs a sign, since `1e05` may be a word.
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
    // If a family has both whole numbers and fractions, such as 1 and 1.5, the former have an empty second number.
    name_.integers.push_back(fraction.empty() ? NameNumber{} : number(negative, fraction, {}, 0));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  NumberedName name_;
};

/// Replaces the name of a folder by the first spelling under which it occurred.
class FolderNames {
 public:
  const fs::path& of(const fs::path& folder) {
    const auto [known, is_new] = names_.try_emplace(folder.string());
    if (is_new) {
      std::error_code error;
      const fs::path place = fs::weakly_canonical(folder.empty() ? "." : folder, error);
      const auto first = places_.try_emplace(error ? folder.string() : place.string(), folder.lexically_normal()).first;
      known->second = first->second;
    }
    return known->second;
  }

 private:
  std::map<std::string, fs::path> names_;   ///< by spelling
  std::map<std::string, fs::path> places_;  ///< by place
};

/// The numbers in the name and its folder, without the extension.
NumberedName numbers_of_name(const fs::path& path, FolderNames& folders) {
  const std::string text = (folders.of(path.parent_path()) / path.stem()).string();
  return Parser(text).parse();
}

// --- Their order ----------------------------------------------------------------------------------------------------

using Key = std::vector<NameNumber> NumberedName::*;

/// A number with more digits does not count frames, and no gaps are looked for.
constexpr std::int64_t most_gap_digits = 18;

struct Pair {
  std::size_t before, after;  ///< places in the order given
};

/// Frames whose names differ in their numbers only.
class Family {
 public:
  void add(std::size_t place, NumberedName name) {
    places_.push_back(place);
    names_.push_back(std::move(name));
  }
  std::size_t size() const { return places_.size(); }

  /// The first frame that has a smaller number than an earlier one, and the first such earlier frame.
  std::optional<Pair> against(Key key) const {
    std::size_t largest = 0;
    for (std::size_t j = 1; j < names_.size(); ++j) {
      if (names_[j].*key >= names_[largest].*key) {
        largest = j;
        continue;
      }
      std::size_t i = 0;
      while (names_[i].*key <= names_[j].*key) ++i;
      return Pair{places_[i], places_[j]};
    }
    return std::nullopt;
  }

  /// Whether `12.5` may be two numbers.
  bool may_be_integers() const {
    bool fraction = false, zero_first = false;
    std::size_t shortest = std::string::npos, longest = 0;
    for (const NumberedName& name : names_) {
      if (name.has_exponent) return false;
      for (const std::string& digits : name.fractions) {
        if (digits.empty()) continue;
        fraction = true;
        zero_first |= digits.size() > 1 && digits[0] == '0';
        shortest = std::min(shortest, digits.size());
        longest = std::max(longest, digits.size());
      }
    }
    return fraction && !(zero_first && shortest != longest);
  }

  /// Puts the places of its frames in the order of their numbers: order[k] is the frame at place k.
  void sort(std::vector<std::size_t>& order) const {
    std::vector<std::size_t> sorted(size());
    std::iota(sorted.begin(), sorted.end(), std::size_t{0});
    std::ranges::stable_sort(
        sorted, {}, [&](std::size_t i) -> const auto& { return names_[i].decimals; });
    for (std::size_t i = 0; i < size(); ++i) order[places_[i]] = places_[sorted[i]];
  }

  /// The numbers that count the frames, ascending, each with one of its frames. Empty unless exactly one number of the
  /// names varies, and is always an integer >= 0.
  std::vector<std::pair<std::uint64_t, std::size_t>> counted() const {
    const auto column = varying();
    if (!column) return {};
    std::map<std::uint64_t, std::size_t> counted;
    for (std::size_t i = 0; i < size(); ++i) {
      const NameNumber& number = names_[i].decimals[*column];
      const bool whole = number.exponent >= static_cast<std::int64_t>(number.digits.size());
      if (number.negative || !whole || number.exponent > most_gap_digits) return {};
      std::string digits = number.digits;
      digits.resize(static_cast<std::size_t>(number.exponent), '0');
      std::uint64_t value = 0;
      parse_number(digits, value);
      counted.emplace(value, places_[i]);
    }
    return {counted.begin(), counted.end()};
  }

 private:
  /// The one number that is not the same in all names.
  std::optional<std::size_t> varying() const {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < names_[0].decimals.size(); ++k) {
      const auto same = [&](const NumberedName& name) { return name.decimals[k] == names_[0].decimals[k]; };
      if (std::ranges::all_of(names_, same)) continue;
      if (found) return std::nullopt;
      found = k;
    }
    return found;
  }

  std::vector<std::size_t> places_;
  std::vector<NumberedName> names_;
};

class Orderer {
 public:
  explicit Orderer(std::vector<fs::path> frames) : frames_(std::move(frames)) {
    std::map<std::string, std::size_t> known;
    FolderNames folders;
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      NumberedName name = numbers_of_name(frames_[k], folders);
      if (name.decimals.empty()) continue;
      const auto [at, is_new] = known.emplace(name.pattern, families_.size());
      if (is_new) families_.emplace_back();
      families_[at->second].add(k, std::move(name));
    }
    std::erase_if(families_, [](const Family& family) { return family.size() < 2; });
  }

  OrderedFrames operator()(FrameOrder order) const {
    OrderedFrames result;
    result.frames = frames_;
    result.how = families_.empty() ? "as given; no two names differ only in their numbers"
                                   : "as given, which is the order of the numbers in the names";
    if (order == FrameOrder::natural) {
      sort(result);
    } else {
      for (const Family& family : families_) {
        const std::string problem = problem_of(family);
        if (problem.empty()) continue;
        if (order == FrameOrder::checked) throw InputError("frames", "", problem + advice());
        result.how = "as given, against the numbers in the names (--order given)";
        result.notes.push_back("frames are in the order given (--order given), against their numbers: " + problem);
        break;
      }
    }
    for (const Family& family : families_) append_capped(result.notes, gaps(family), "gaps in the numbers");
    append_capped(result.notes, twice(result.frames), "files that are given more than once");
    return result;
  }

 private:
  /// The name of the frame at a place in the order given.
  std::string name(std::size_t place) const { return frames_[place].string(); }

  static const char* advice() { return "; pass --order natural, or --order given if this is the order you mean"; }

  /// What is wrong with the order; "" if nothing.
  std::string problem_of(const Family& family) const {
    const bool two_ways = family.may_be_integers();
    const auto decimal = family.against(&NumberedName::decimals);
    const auto integer = two_ways ? family.against(&NumberedName::integers) : std::nullopt;
    if (!decimal && !integer) return "";
    const Pair& pair = decimal ? *decimal : *integer;
    std::string problem = fmt::format("{} comes before {}", name(pair.before), name(pair.after));
    if (!decimal) problem += ", which is right only if the numbers are decimals (0.10 before 0.9)";
    if (two_ways && !integer) problem += ", which is against their numbers if these are decimals (0.10 before 0.9)";
    return problem;
  }

  void sort(OrderedFrames& result) const {
    result.how = "sorted by the numbers in the names (--order natural)";
    std::vector<std::size_t> order(frames_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (const Family& family : families_) family.sort(order);
    std::size_t moved = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      result.frames[k] = frames_[order[k]];
      moved += order[k] != k;
    }
    if (moved > 0) {
      result.notes.push_back(
          fmt::format("frames were sorted by the numbers in their names (--order natural): {} of {} changed places",
                      moved, order.size()));
    }
  }

  /// Differences of successive numbers that are larger than the most frequent one.
  std::vector<std::string> gaps(const Family& family) const {
    const auto counted = family.counted();
    if (counted.size() < 3) return {};
    std::map<std::uint64_t, std::size_t> strides;
    for (std::size_t i = 1; i < counted.size(); ++i) ++strides[counted[i].first - counted[i - 1].first];
    const std::uint64_t stride = std::ranges::max_element(strides, {}, [](const auto& s) { return s.second; })->first;
    std::vector<std::string> found;
    for (std::size_t i = 1; i < counted.size(); ++i) {
      const auto& [low, before] = counted[i - 1];
      const auto& [high, after] = counted[i];
      if (high - low <= stride) continue;
      found.push_back(fmt::format("{} to {}: {}", name(before), name(after), missing(low, high, stride)));
    }
    return found;
  }

  static std::string missing(std::uint64_t low, std::uint64_t high, std::uint64_t stride) {
    if ((high - low) % stride != 0) {
      return fmt::format("the number grows by {} here, usually by {}", high - low, stride);
    }
    if (high - low == 2 * stride) return fmt::format("frame {} is missing", low + stride);
    const std::string by = stride > 1 ? fmt::format(", by {},", stride) : "";
    return fmt::format("frames {} to {}{} are missing", low + stride, high - stride, by);
  }

  static std::vector<std::string> twice(const std::vector<fs::path>& frames) {
    std::map<std::string, std::vector<std::size_t>> places;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      places[fs::absolute(frames[k]).lexically_normal().string()].push_back(k + 1);
    }
    std::vector<std::string> found;
    for (const fs::path& frame : frames) {
      auto& at = places[fs::absolute(frame).lexically_normal().string()];
      if (at.size() < 2) continue;
      const std::string times = at.size() == 2 ? "twice" : fmt::format("{} times", at.size());
      if (at.size() > most_notes_of_a_kind) at.resize(most_notes_of_a_kind);
      found.push_back(fmt::format("{} is given {}: as frames {}", frame.string(), times, fmt::join(at, ", ")));
      at.clear();
    }
    return found;
  }

  std::vector<fs::path> frames_;  ///< as given
  std::vector<Family> families_;
};

}  // namespace

void append_capped(std::vector<std::string>& notes, const std::vector<std::string>& more, std::string_view what) {
  const std::size_t shown = std::min(more.size(), most_notes_of_a_kind);
  notes.insert(notes.end(), more.begin(), more.begin() + static_cast<std::ptrdiff_t>(shown));
  if (shown < more.size()) notes.push_back(fmt::format("and {} more {}", more.size() - shown, what));
}

OrderedFrames order_frames(std::vector<fs::path> frames, FrameOrder order) { return Orderer(std::move(frames))(order); }

}  // namespace noli
