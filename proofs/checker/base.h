// SPDX-License-Identifier: Apache-2.0
//
// What everything here stands on: how a check ends early, files, what is read from them, and the two checksums.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace noli::checker {

static_assert(std::endian::native == std::endian::little, "numbers are read as they are in memory");

/// Wide enough for a product of two 64-bit numbers.
__extension__ using Wide = __int128;

/// The check ends: where in which file, and why.
struct Rejected {
  std::string where, why;
};

inline void require(bool condition, const std::string& where, const char* why) {
  if (!condition) throw Rejected{where, why};
}

/// A file, or with the name - the standard input, read once from its beginning to its end.
class Input {
 public:
  explicit Input(const std::string& name)
      : name_(name), file_(name == "-" ? stdin : std::fopen(name.c_str(), "rb"), std::fclose) {
    checker::require(file_ != nullptr, name, "cannot be opened");
  }
  /// So many bytes, or all up to the end. No length is believed: memory grows with what has come.
  std::string read(std::uint64_t bytes) {
    std::string result;
    for (std::size_t got = 1; got > 0 && result.size() < bytes;) {
      const std::size_t have = result.size(), part = std::min<std::uint64_t>(bytes - have, 1 << 20);
      result.resize(have + part);
      got = std::fread(result.data() + have, 1, part, file_.get());
      result.resize(have + got);
    }
    checker::require(std::ferror(file_.get()) == 0, name_, "cannot be read");
    return result;
  }

 private:
  std::string name_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// Bytes that are taken one after another, or line by line. What is wrong is said with its place.
class Reader {
 public:
  Reader(std::string bytes, std::string file, std::uint64_t offset = 0)
      : bytes_(std::move(bytes)), file_(std::move(file)), offset_(offset) {}

  void require(bool condition, const char* why) const {
    if (!condition)
      throw Rejected{
          file_ + (line_ > 0 ? ", line " + std::to_string(line_) : ", byte " + std::to_string(offset_ + at_)), why};
  }
  std::string_view all() const { return bytes_; }
  std::size_t left() const { return bytes_.size() - at_; }
  /// That many things, of so many bytes each, are left.
  void need(std::uint64_t count, std::uint64_t size) const {
    require(count <= left() / size, "more is announced here than is left");
  }
  std::string_view take(std::uint64_t bytes) {
    require(bytes <= left(), "expected more bytes");
    at_ += bytes;
    return std::string_view(bytes_).substr(at_ - bytes, bytes);
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
    const mpz_class value = groups(10);
    require(value.fits_ulong_p(), "expected an integer below 2^64");
    return value.get_ui();
  }
  mpz_class sint() {
    const mpz_class u = groups(1200), half = u / 2;
    return u % 2 == 0 ? half : mpz_class(-half - 1);
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
  void end() const { require(left() == 0, "expected the end here"); }
  /// The next line of a text, without its end; none where all has been read.
  std::optional<std::string_view> line() {
    if (left() == 0) return std::nullopt;
    ++line_;
    std::string_view line = take(std::min(bytes_.find('\n', at_), bytes_.size()) - at_);
    if (left() > 0) ++at_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  /// What follows the lines is bytes.
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
  mpz_class groups(unsigned long most) {
    mpz_class value = 0;
    for (unsigned long n = 0;; ++n) {
      require(n < most, "an integer is too long");
      const std::uint8_t byte = u8();
      require(n == 0 || byte != 0, "an integer is written longer than it is");
      value += mpz_class(byte & 0x7f) << 7 * n;
      if (byte < 0x80) return value;
    }
  }

  std::string bytes_, file_;
  std::uint64_t offset_, line_ = 0;
  std::size_t at_ = 0;
};

/// The words of a line.
inline std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(" \t", end);
  }
  return words;
}

/// CRC-32C of some bytes and of those before them; eight at a time.
inline std::uint32_t crc32c(std::string_view bytes, std::uint32_t before = 0) {
  static const auto table = [] {  // [k][i]: of byte i and k bytes of 0 behind it
    std::array<std::array<std::uint32_t, 256>, 8> t{};
    for (std::uint32_t k = 0; k < 8; ++k) {
      for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t c = k == 0 ? i : t[k - 1][i];
        for (int bit = 0; bit < 8; ++bit) c = c >> 1 ^ ((c & 1) != 0 ? 0x82F63B78u : 0);
        t[k][i] = c;
      }
    }
    return t;
  }();
  std::uint32_t crc = ~before;
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data(), 8);
    word ^= crc;
    crc = 0;
    for (std::size_t i = 0; i < 8; ++i) crc ^= table[7 - i][word >> (8 * i) & 0xff];
  }
  for (const char byte : bytes) crc = table[0][(crc ^ static_cast<std::uint8_t>(byte)) & 0xff] ^ crc >> 8;
  return ~crc;
}

/// SHA-256, FIPS 180-4.
class Sha256 {
 public:
  using Digest = std::array<std::uint8_t, 32>;

  void add(std::string_view bytes) {
    size_ += bytes.size();
    while (!bytes.empty()) {
      const std::size_t n = std::min(bytes.size(), block_.size() - used_);
      std::memcpy(block_.data() + used_, bytes.data(), n);
      bytes.remove_prefix(n);
      used_ += n;
      if (used_ == block_.size()) compress();
    }
  }
  template <class T>
  void add_raw(const T& value) {
    add({reinterpret_cast<const char*>(&value), sizeof value});
  }
  Digest digest() {
    const std::uint64_t bits = __builtin_bswap64(8 * size_);
    add(std::string_view("\x80", 1));
    while (used_ != 56) add(std::string_view("\0", 1));
    add_raw(bits);
    for (auto& word : state_) word = __builtin_bswap32(word);
    return std::bit_cast<Digest>(state_);
  }

 private:
  void compress() {
    static constexpr std::array<std::uint32_t, 64> k = {
        0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
        0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
        0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
        0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
        0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
        0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
        0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
        0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};
    std::array<std::uint32_t, 64> w;
    std::memcpy(w.data(), block_.data(), block_.size());
    for (std::size_t i = 0; i < 16; ++i) w[i] = __builtin_bswap32(w[i]);
    for (std::size_t i = 16; i < 64; ++i) {
      const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ w[i - 15] >> 3;
      const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ w[i - 2] >> 10;
      w[i] = w[i - 16] + s0 + w[i - 7] + s1;
    }
    std::array<std::uint32_t, 8> v = state_;
#pragma GCC unroll 64
    for (std::size_t i = 0; i < 64; ++i) {
      // What the standard calls a to h is v from place -i on, so that nothing has to be moved.
      const auto at = [&](std::size_t place) -> std::uint32_t& { return v[(64 + place - i) % 8]; };
      const std::uint32_t a = at(0), e = at(4);
      const std::uint32_t t1 = at(7) + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                               (at(6) ^ (e & (at(5) ^ at(6)))) + k[i] + w[i];
      at(3) += t1;
      at(7) = t1 + (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & at(1)) | (at(2) & (a | at(1))));
    }
    for (std::size_t i = 0; i < 8; ++i) state_[i] += v[i];
    used_ = 0;
  }

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<char, 64> block_;
  std::size_t used_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace noli::checker
