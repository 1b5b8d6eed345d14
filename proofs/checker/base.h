// SPDX-License-Identifier: Apache-2.0
//
// The basis of the checker: how a check ends early, files, and the bytes and numbers in them.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace noli::checker {

static_assert(std::endian::native == std::endian::little, "numbers are read as they are in memory");

__extension__ using Wide = __int128;

/// The check ends early: where in which file, and why.
struct Rejected {
  std::string where, why;
};

inline void require(bool condition, const std::string& where, const char* why) {
  if (!condition) throw Rejected{where, why};
}

/// A file, or the standard input if its name is -, read once from beginning to end.
class Input {
 public:
  explicit Input(const std::string& name)
      : name_(name), file_(name == "-" ? stdin : std::fopen(name.c_str(), "rb"), std::fclose) {
    checker::require(file_ != nullptr, name, "cannot be opened");
  }
  /// Reads this many bytes, or all up to the end. Lengths are not trusted: memory grows with the bytes that were read.
  std::string read(std::uint64_t bytes) {
    std::string result;
    result.reserve(std::min<std::uint64_t>(bytes, 1 << 26));
    for (std::size_t got = 1; got > 0 && result.size() < bytes;) {
      const std::uint64_t have = result.size(), most = std::clamp<std::uint64_t>(have, 1 << 14, 1 << 20);
      const std::uint64_t part = std::min(bytes - have, most);
      result.resize(have + part);
      got = std::fread(result.data() + have, 1, part, file_.get());
      result.resize(have + got);
    }
    checker::require(std::ferror(file_.get()) == 0, name_, "cannot be read");
    return result;
  }
  /// Whether a byte is left. Does not consume it.
  bool more() { return std::ungetc(std::fgetc(file_.get()), file_.get()) != EOF; }

 private:
  std::string name_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// Takes bytes one after another, or line by line. Errors name the place.
class Reader {
 public:
  Reader(std::string bytes, std::string file, std::uint64_t offset = 0)
      : bytes_(std::move(bytes)), file_(std::move(file)), offset_(offset) {}

  void require(bool condition, const char* why) const {
    if (!condition) reject(why);
  }
  [[noreturn]] void reject(const char* why) const {
    const std::string place = line_ > 0 ? "line " + std::to_string(line_) : "byte " + std::to_string(offset_ + at_);
    throw Rejected{file_ + ", " + place, why};
  }
  std::string_view all() const { return bytes_; }
  std::size_t left() const { return bytes_.size() - at_; }
  /// Requires that at least `count` items of `size` bytes are left.
  void need(std::uint64_t count, std::uint64_t size) const {
    require(count <= left() / size, "more is announced here than is left");
  }
  void end() const { require(left() == 0, "expected the end here"); }
  std::string_view take(std::uint64_t bytes) {
    require(bytes <= left(), "expected more bytes");
    at_ += bytes;
    return {bytes_.data() + at_ - bytes, bytes};
  }
  template <class T>
  T raw() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::uint8_t u8() { return raw<std::uint8_t>(); }
  std::uint32_t u32() { return raw<std::uint32_t>(); }
  std::uint64_t u64() { return raw<std::uint64_t>(); }
  double f64() {
    const auto value = raw<double>();
    require(std::isfinite(value), "expected a finite number");
    return value;
  }
  std::uint64_t uint() {
    const auto value = groups<Wide>(10);
    require(value >> 64 == 0, "expected an integer below 2^64");
    return static_cast<std::uint64_t>(value);
  }
  mpz_class sint() {
    const auto u = groups<mpz_class>(1200);
    return u % 2 == 0 ? mpz_class(u / 2) : mpz_class(-(u + 1) / 2);
  }
  unsigned long shift() {
    const std::uint64_t s = uint();
    require(s <= 4096, "a shift is above 4,096");
    return s;
  }
  mpz_class scaled() {
    const unsigned long s = shift();
    return sint() << s;
  }
  /// The next line of a text, without its end; nothing at the end of the text.
  std::optional<std::string_view> line() {
    if (left() == 0) return std::nullopt;
    ++line_;
    std::string_view line = take(std::min(bytes_.find('\n', at_), bytes_.size()) - at_);
    if (left() > 0) ++at_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  /// Bytes follow the lines.
  void no_more_lines() { line_ = 0; }
  /// A word as a number of this type, rounded correctly.
  template <class T>
  T number(std::string_view word) const {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    require(error == std::errc{} && end == word.data() + word.size(), "expected a number of its type");
    return value;
  }

 private:
  /// Groups of seven bits; the last one is not 0 unless it is the only one.
  template <class Integer>
  Integer groups(unsigned long most) {
    Integer value = 0;
    for (unsigned long n = 0;; ++n) {
      require(n < most, "an integer is too long");
      const std::uint8_t byte = u8();
      require(n == 0 || byte != 0, "an integer is written longer than it is");
      value += Integer(byte & 0x7f) << 7 * n;
      if (byte < 0x80) return value;
    }
  }

  std::string bytes_, file_;
  std::uint64_t offset_, line_ = 0;
  std::size_t at_ = 0;
};

}  // namespace noli::checker
