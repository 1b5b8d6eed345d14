// SPDX-License-Identifier: Apache-2.0
//
// Reads block files (trajectory/FORMAT.md), and computes the two checksums in them.
#pragma once

#ifdef __x86_64__
#include <cpuid.h>
#include <immintrin.h>
#endif

#include "base.h"

namespace noli::checker {

#ifdef __x86_64__
/// Whether the processor has instructions for both; tests try both ways.
inline bool by_instructions = [] {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b >> 29 & 1) != 0 && __builtin_cpu_supports("sse4.2");
}();

__attribute__((target("sse4.2"))) inline std::uint64_t crc32c_by_instructions(std::string_view& bytes,
                                                                              std::uint64_t crc) {
  std::uint64_t word = 0;
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    std::memcpy(&word, bytes.data(), 8);
    crc = _mm_crc32_u64(crc, word);
  }
  return crc;
}
#endif

/// CRC-32C of some bytes and of those before them, computed eight bytes at a time.
inline std::uint32_t crc32c(std::string_view bytes, std::uint32_t before = 0) {
  static const auto table = [] {  // [k][i]: of byte i followed by k bytes of 0
    std::array<std::array<std::uint32_t, 256>, 8> t{};
    for (std::uint32_t i = 0; i < 8 * 256; ++i) {
      std::uint32_t c = i < 256 ? i : t[i / 256 - 1][i % 256];
      for (int bit = 0; bit < 8; ++bit) c = c >> 1 ^ ((c & 1) != 0 ? 0x82F63B78u : 0);
      t[i / 256][i % 256] = c;
    }
    return t;
  }();
  std::uint32_t crc = ~before;
#ifdef __x86_64__
  if (by_instructions) crc = static_cast<std::uint32_t>(crc32c_by_instructions(bytes, crc));
#endif
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
  static constexpr std::array<std::uint32_t, 64> k = {
      0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
      0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
      0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
      0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
      0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
      0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
      0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
      0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

  void compress() {
    used_ = 0;
#ifdef __x86_64__
    if (by_instructions) return compress_by_instructions();
#endif
    auto [a, b, c, d, e, f, g, h] = state_;
    auto w = std::bit_cast<std::array<std::uint32_t, 16>>(block_);
    for (auto& word : w) word = __builtin_bswap32(word);
#pragma GCC unroll 64
    for (std::size_t i = 0; i < 64; ++i) {
      const std::uint32_t t1 =
          h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) + (g ^ (e & (f ^ g))) + k[i] + w[i % 16];
      const std::uint32_t t2 = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) | (c & (a | b)));
      h = std::exchange(g, std::exchange(f, std::exchange(e, d + t1)));
      d = std::exchange(c, std::exchange(b, std::exchange(a, t1 + t2)));
      const std::uint32_t x = w[(i + 1) % 16], y = w[(i + 14) % 16];  // word i + 16 follows those from i on
      w[i % 16] += (std::rotr(x, 7) ^ std::rotr(x, 18) ^ x >> 3) + w[(i + 9) % 16] +
                   (std::rotr(y, 17) ^ std::rotr(y, 19) ^ y >> 10);
    }
    const std::array<std::uint32_t, 8> sum = {a, b, c, d, e, f, g, h};
    for (std::size_t i = 0; i < 8; ++i) state_[i] += sum[i];
  }

#ifdef __x86_64__
  /// The same by the processor's instructions, four rounds at a time. They need the words a b e f and c d g h together,
  /// the first of each highest.
  struct Halves {
    __m128i first, second;
  };
  __attribute__((target("sha,sse4.1"))) void compress_by_instructions() {
    const auto vector = [](const auto& array, std::size_t at) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(array.data() + at));
    };
    const __m128i cdab = _mm_shuffle_epi32(vector(state_, 0), 0xB1), efgh = _mm_shuffle_epi32(vector(state_, 4), 0x1B);
    const __m128i abef_before = _mm_alignr_epi8(cdab, efgh, 8), cdgh_before = _mm_blend_epi16(efgh, cdab, 0xF0);
    const __m128i swapped = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
    __m128i w[4];
    for (std::size_t i = 0; i < 4; ++i) w[i] = _mm_shuffle_epi8(vector(block_, 16 * i), swapped);
    __m128i abef = abef_before, cdgh = cdgh_before;
#pragma GCC unroll 16
    for (std::size_t i = 0; i < 16; ++i) {
      const __m128i sum = _mm_add_epi32(w[i % 4], vector(k, 4 * i));
      const __m128i nine = _mm_alignr_epi8(w[(i + 3) % 4], w[(i + 2) % 4], 4);
      cdgh = _mm_sha256rnds2_epu32(cdgh, abef, sum);
      abef = _mm_sha256rnds2_epu32(abef, cdgh, _mm_shuffle_epi32(sum, 0x0E));
      w[i % 4] =
          _mm_sha256msg2_epu32(_mm_add_epi32(_mm_sha256msg1_epu32(w[i % 4], w[(i + 1) % 4]), nine), w[(i + 3) % 4]);
    }
    abef = _mm_shuffle_epi32(_mm_add_epi32(abef, abef_before), 0x1B);
    cdgh = _mm_shuffle_epi32(_mm_add_epi32(cdgh, cdgh_before), 0xB1);
    state_ = std::bit_cast<std::array<std::uint32_t, 8>>(
        Halves{_mm_blend_epi16(abef, cdgh, 0xF0), _mm_alignr_epi8(cdgh, abef, 8)});
  }
#endif

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<char, 64> block_{};
  std::size_t used_ = 0;
  std::uint64_t size_ = 0;
};

struct Block {
  std::string kind;
  Reader data;  ///< the payload
};

/// Committed groups of blocks, one after another.
class BlockFile {
 public:
  BlockFile(const std::string& name, std::string_view content) : name_(name), input_(name) {
    const std::string head = input_.read(16);
    require(head.starts_with(std::string_view("\x89NOLI\r\n\x1a\1\0\0\0", 12)), 0, "expected a block file, version 1");
    require(head.substr(12) == content, 12, "the file has another content");
    group_.add(head);
  }

  /// The next block of the open group, except CMIT; nothing at its end, and at the end of the file, where ended() is
  /// true. Anything after the last commit is rejected, so blocks count only when their group has ended.
  std::optional<Block> next() {
    block_at_ = at_;
    const std::string head = input_.read(12);
    ended_ = head.empty() && groups_ > 0 && blocks_ == 0;
    if (ended_) return std::nullopt;
    complete(head.size() == 12);
    std::string payload = input_.read(Reader(head.substr(4), name_).u64());
    const std::string sum = input_.read(4);
    complete(sum.size() == 4);
    at_ += 16 + payload.size();
    require(Reader(sum, name_).u32() == crc32c(payload, crc32c(head)), at_ - 4, "the checksum is wrong");
    Block block{head.substr(0, 4), Reader(std::move(payload), name_, block_at_ + 12)};
    if (block.kind == "CMIT") return commit(block.data);
    group_.add(head);
    group_.add(block.data.all());
    group_.add(sum);
    ++blocks_;
    return block;
  }
  /// The payload of a block, which must have this kind.
  Reader as(const std::string& kind, std::optional<Block> block) const {
    require(block && block->kind == kind, block_at_, "expected a block " + kind);
    return std::move(block->data);
  }
  Reader expect(const std::string& kind) { return as(kind, next()); }
  void expect_commit() { require(!next(), block_at_, "expected a commit"); }
  bool ended() const { return ended_; }
  /// Whether something follows, which is not read.
  bool more() { return input_.more(); }
  /// The hash of the last committed group.
  const Sha256::Digest& group_hash() const { return last_; }
  /// The running hash: of all committed groups.
  const Sha256::Digest& hash() const { return running_; }

 private:
  void require(bool condition, std::uint64_t offset, const std::string& why) const {
    if (!condition) throw Rejected{name_ + ", byte " + std::to_string(offset), why};
  }
  void complete(bool block) const {
    const std::string groups = std::to_string(groups_);
    require(block, committed_, "an open group, behind " + groups + " that have a commit (the first is the head)");
  }
  std::nullopt_t commit(Reader& c) {
    c.require(c.left() == 72, "expected 72 bytes");
    c.require(c.u64() == groups_, "a commit has the wrong number");
    last_ = group_.digest();
    Sha256 both;
    both.add_raw(std::array{running_, last_});
    running_ = both.digest();
    c.require(c.raw<Sha256::Digest>() == last_, "the hash of the group is wrong");
    c.require(c.raw<Sha256::Digest>() == running_, "the running hash is wrong");
    group_ = {};
    blocks_ = 0;
    ++groups_;
    committed_ = at_;
    return std::nullopt;
  }

  std::string name_;
  Input input_;
  std::uint64_t at_ = 16, block_at_ = 16, groups_ = 0, blocks_ = 0, committed_ = 0;
  bool ended_ = false;
  Sha256 group_;
  Sha256::Digest running_{}, last_{};
};

}  // namespace noli::checker
