// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/sha256_blocks.h"

#include <bit>
#include <cstddef>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace noli {
namespace {

/// The first 32 bits of the fractional parts of the cube roots of the first 64 primes (FIPS 180-4, section 4.2.2).
constexpr std::array<std::uint32_t, 64> round_constants = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

std::uint32_t big_endian_word(const char* p) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(p[i]);
  return value;
}

/// The message schedule W of the standard.
std::array<std::uint32_t, 64> schedule(const char* block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t t = 0; t < 16; ++t) w[t] = big_endian_word(block + 4 * t);
  for (std::size_t t = 16; t < 64; ++t) {
    const std::uint32_t s0 = std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ w[t - 15] >> 3;
    const std::uint32_t s1 = std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ w[t - 2] >> 10;
    w[t] = s1 + w[t - 7] + s0 + w[t - 16];
  }
  return w;
}

void plain_block(Sha256State& state, const char* block) {
  const auto w = schedule(block);
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + round_constants[t] + w[t];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1;
    d = c, c = b, b = a, a = t1 + t2;
  }
  const Sha256State last = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state[i] += last[i];
}

}  // namespace

void sha256_blocks_plain(Sha256State& state, std::string_view blocks) {
  for (std::size_t at = 0; at < blocks.size(); at += 64) plain_block(state, blocks.data() + at);
}

#if defined(__x86_64__)

bool has_sha_instructions() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid_count(7, 0, &a, &b, &c, &d) == 0 || (b & 1u << 29) == 0) return false;    // SHA
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & 1u << 9) != 0 && (c & 1u << 19) != 0;  // SSSE3, SSE4.1
}

#define NOLI_SHA_TARGET __attribute__((target("sha,sse4.1,ssse3")))

namespace {

/// The state in the layout of the instructions: the words a b e f and c d g h, the first of each highest.
struct Halves {
  __m128i abef, cdgh;
};

NOLI_SHA_TARGET __m128i load(const void* p) { return _mm_loadu_si128(static_cast<const __m128i*>(p)); }

/// Rounds t .. t + 3; `w` is W[t] .. W[t + 3].
NOLI_SHA_TARGET void four_rounds(Halves& state, __m128i w, std::size_t t) {
  const __m128i sum = _mm_add_epi32(w, load(round_constants.data() + t));
  state.cdgh = _mm_sha256rnds2_epu32(state.cdgh, state.abef, sum);
  state.abef = _mm_sha256rnds2_epu32(state.abef, state.cdgh, _mm_shuffle_epi32(sum, 0x0e));
}

/// The next four words of the schedule, after the sixteen in w0 .. w3.
NOLI_SHA_TARGET __m128i next_words(__m128i w0, __m128i w1, __m128i w2, __m128i w3) {
  const __m128i seven_back = _mm_alignr_epi8(w3, w2, 4);
  return _mm_sha256msg2_epu32(_mm_add_epi32(_mm_sha256msg1_epu32(w0, w1), seven_back), w3);
}

NOLI_SHA_TARGET __m128i big_endian_words(const char* p) {
  return _mm_shuffle_epi8(load(p), _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203));
}

NOLI_SHA_TARGET void instruction_block(Halves& state, const char* block) {
  const Halves before = state;
  __m128i w0 = big_endian_words(block), w1 = big_endian_words(block + 16);
  __m128i w2 = big_endian_words(block + 32), w3 = big_endian_words(block + 48);
  for (std::size_t t = 0; t < 64; t += 4) {
    four_rounds(state, w0, t);
    const __m128i next = next_words(w0, w1, w2, w3);
    w0 = w1, w1 = w2, w2 = w3, w3 = next;
  }
  state.abef = _mm_add_epi32(state.abef, before.abef);
  state.cdgh = _mm_add_epi32(state.cdgh, before.cdgh);
}

}  // namespace

NOLI_SHA_TARGET void sha256_blocks_by_instructions(Sha256State& state, std::string_view blocks) {
  std::array<int, 8> s{};
  for (std::size_t i = 0; i < 8; ++i) s[i] = static_cast<int>(state[i]);
  Halves halves{_mm_set_epi32(s[0], s[1], s[4], s[5]), _mm_set_epi32(s[2], s[3], s[6], s[7])};
  for (std::size_t at = 0; at < blocks.size(); at += 64) instruction_block(halves, blocks.data() + at);
  std::array<std::uint32_t, 8> words{};
  _mm_storeu_si128(reinterpret_cast<__m128i*>(words.data()), halves.abef);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(words.data() + 4), halves.cdgh);
  state = {words[3], words[2], words[7], words[6], words[1], words[0], words[5], words[4]};
}

#else

bool has_sha_instructions() { return false; }
void sha256_blocks_by_instructions(Sha256State& state, std::string_view blocks) { sha256_blocks_plain(state, blocks); }

#endif

void sha256_blocks(Sha256State& state, std::string_view blocks) {
  static const bool by_instructions = has_sha_instructions();
  by_instructions ? sha256_blocks_by_instructions(state, blocks) : sha256_blocks_plain(state, blocks);
}

}  // namespace noli
