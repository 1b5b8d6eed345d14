// SPDX-License-Identifier: Apache-2.0
//
// What everything here stands on: how a check ends early, bytes, and the two checksums.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace noli::checker {

/// Wide enough for a product of two 64-bit numbers.
__extension__ using Wide = __int128;

/// The check ends: where in which file, and why.
struct Rejected {
  std::string where, why;
};

[[noreturn]] inline void reject(const std::string& where, const std::string& why) { throw Rejected{where, why}; }

/// Bytes of a file that are read one after another; each read is within them or rejected.
class Cursor {
 public:
  Cursor(std::string_view bytes, std::string file, std::uint64_t offset = 0)
      : bytes_(bytes), file_(std::move(file)), offset_(offset) {}

  std::size_t left() const { return bytes_.size() - at_; }
  std::string place() const { return file_ + ", byte " + std::to_string(offset_ + at_); }
  [[noreturn]] void fail(const std::string& why) const { reject(place(), why); }
  void need(std::uint64_t bytes) const {
    if (bytes > left()) fail("expected " + std::to_string(bytes) + " more bytes, found " + std::to_string(left()));
  }
  /// That many things of so many bytes each are left.
  void need(std::uint64_t count, std::uint64_t size) const {
    if (count > left() / size) fail("a count of " + std::to_string(count) + " does not fit into what is left");
  }
  std::string_view take(std::uint64_t bytes) {
    need(bytes);
    at_ += bytes;
    return bytes_.substr(at_ - bytes, bytes);
  }
  template <class T>
  T raw() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::uint8_t u8() { return raw<std::uint8_t>(); }
  std::uint16_t u16() { return raw<std::uint16_t>(); }
  std::uint32_t u32() { return raw<std::uint32_t>(); }
  std::uint64_t u64() { return raw<std::uint64_t>(); }
  std::int32_t i32() { return raw<std::int32_t>(); }
  double f64() {
    const double value = raw<double>();
    if (!std::isfinite(value)) fail("expected a finite number");
    return value;
  }
  /// Groups of seven bits; the last one is not 0 unless it is the only one.
  std::string_view groups(std::size_t most) {
    std::size_t n = 1;
    while (n <= left() && n <= most && (bytes_[at_ + n - 1] & 0x80) != 0) ++n;
    if (n > most) fail("an integer is longer than " + std::to_string(most) + " bytes");
    need(n);
    if (n > 1 && bytes_[at_ + n - 1] == 0) fail("an integer is written longer than it is");
    return take(n);
  }
  std::uint64_t uint() {
    const std::string_view g = groups(10);
    if (g.size() == 10 && g[9] != 1) fail("expected an integer below 2^64");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < g.size(); ++i)
      value |= std::uint64_t{static_cast<std::uint8_t>(g[i] & 0x7f)} << (7 * i);
    return value;
  }
  void end() const {
    if (left() != 0) fail("expected the end here, found " + std::to_string(left()) + " more bytes");
  }

 private:
  std::string_view bytes_;
  std::string file_;
  std::uint64_t offset_;
  std::size_t at_ = 0;
};

static_assert(std::endian::native == std::endian::little, "numbers are read as they are in memory");

/// CRC-32C, eight bytes at a time.
class Crc32c {
 public:
  void add(std::string_view bytes) {
    static const std::vector<std::array<std::uint32_t, 256>> table = make_table();
    const auto* p = reinterpret_cast<const std::uint8_t*>(bytes.data());
    std::size_t n = bytes.size();
    for (; n >= 8; p += 8, n -= 8) {
      std::uint64_t word;
      std::memcpy(&word, p, 8);
      word ^= crc_;
      crc_ = 0;
      for (std::size_t i = 0; i < 8; ++i) crc_ ^= table[7 - i][word >> (8 * i) & 0xff];
    }
    for (; n > 0; ++p, --n) crc_ = table[0][(crc_ ^ *p) & 0xff] ^ (crc_ >> 8);
  }
  std::uint32_t value() const { return ~crc_; }

 private:
  static std::vector<std::array<std::uint32_t, 256>> make_table() {
    std::vector<std::array<std::uint32_t, 256>> table(8);
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1) != 0 ? 0x82F63B78u : 0);
      table[0][i] = c;
    }
    for (std::size_t k = 1; k < 8; ++k) {
      for (std::size_t i = 0; i < 256; ++i) table[k][i] = table[0][table[k - 1][i] & 0xff] ^ (table[k - 1][i] >> 8);
    }
    return table;
  }
  std::uint32_t crc_ = 0xffffffff;
};

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
    const std::uint64_t bits = 8 * size_;
    add(std::string_view("\x80", 1));
    while (used_ != 56) add(std::string_view("\0", 1));
    std::array<char, 8> length;
    for (std::size_t i = 0; i < 8; ++i) length[i] = static_cast<char>(bits >> (56 - 8 * i));
    add({length.data(), 8});
    Digest result;
    for (std::size_t i = 0; i < 32; ++i) result[i] = static_cast<std::uint8_t>(state_[i / 4] >> (24 - 8 * (i % 4)));
    return result;
  }

 private:
  /// The first 32 bits of the fractional part of the root (2nd or 3rd) of a prime, by integer bisection.
  static std::uint32_t root_bits(std::uint32_t prime, int degree) {
    std::uint64_t low = 0, high = std::uint64_t{1} << 37;  // floor(root * 2^32) is between
    while (high - low > 1) {
      const std::uint64_t middle = (low + high) / 2;
      // Compares middle^degree with prime * 2^(32 * degree); a cube is compared without its lowest bits, exactly.
      const Wide square = Wide{middle} * middle;
      const bool below = degree == 2 ? square <= (Wide{prime} << 64) : cube_at_most(square, middle, prime);
      (below ? low : high) = middle;
    }
    return static_cast<std::uint32_t>(low);
  }
  /// square * m <= prime * 2^96, all of it below 2^111: both are within 128 bits.
  static bool cube_at_most(Wide square, std::uint64_t m, std::uint32_t prime) {
    return square * m <= Wide{prime} << 96;
  }
  static std::array<std::uint32_t, 64> constants(int degree) {
    std::array<std::uint32_t, 64> k{};
    std::uint32_t prime = 2;
    for (auto& value : k) {
      value = root_bits(prime, degree);
      for (bool composite = true; composite;) {
        ++prime;
        composite = false;
        for (std::uint32_t f = 2; f * f <= prime; ++f) composite = composite || prime % f == 0;
      }
    }
    return k;
  }
  void compress() {
    static const std::array<std::uint32_t, 64> k = constants(3);
    std::array<std::uint32_t, 64> w;
    for (std::size_t i = 0; i < 16; ++i) {
      std::memcpy(&w[i], block_.data() + 4 * i, 4);
      w[i] = __builtin_bswap32(w[i]);
    }
    for (std::size_t i = 16; i < 64; ++i) {
      const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
      const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
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
  static std::array<std::uint32_t, 8> initial() {
    static const auto roots = constants(2);
    std::array<std::uint32_t, 8> s;
    std::copy_n(roots.begin(), 8, s.begin());
    return s;
  }

  std::array<std::uint32_t, 8> state_ = initial();
  std::array<char, 64> block_;
  std::size_t used_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace noli::checker
