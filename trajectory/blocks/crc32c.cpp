// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/crc32c.h"

#include <array>
#include <cstddef>
#include <cstring>

#if defined(__x86_64__)
#include <nmmintrin.h>
#endif

namespace noli {
namespace {

/// The Castagnoli polynomial with its bits reversed: the lowest bit of a byte comes first.
constexpr std::uint32_t polynomial = 0x82F63B78;

using Table = std::array<std::uint32_t, 256>;

constexpr std::uint32_t divide_byte(std::uint32_t remainder) {
  for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? polynomial : 0);
  return remainder;
}

/// tables[k][b]: what byte b contributes when k more bytes follow it. So eight bytes take eight independent look-ups.
constexpr std::array<Table, 8> make_tables() {
  std::array<Table, 8> tables{};
  for (std::uint32_t b = 0; b < 256; ++b) tables[0][b] = divide_byte(b);
  for (std::size_t k = 1; k < 8; ++k) {
    for (std::size_t b = 0; b < 256; ++b) {
      const std::uint32_t before = tables[k - 1][b];
      tables[k][b] = (before >> 8) ^ tables[0][before & 0xff];
    }
  }
  return tables;
}

constexpr std::array<Table, 8> tables = make_tables();

std::uint32_t word(const unsigned char* p) {
  return std::uint32_t{p[0]} | std::uint32_t{p[1]} << 8 | std::uint32_t{p[2]} << 16 | std::uint32_t{p[3]} << 24;
}

std::uint32_t eight_bytes(std::uint32_t state, const unsigned char* p) {
  const std::uint32_t low = state ^ word(p), high = word(p + 4);
  return tables[7][low & 0xff] ^ tables[6][low >> 8 & 0xff] ^ tables[5][low >> 16 & 0xff] ^ tables[4][low >> 24] ^
         tables[3][high & 0xff] ^ tables[2][high >> 8 & 0xff] ^ tables[1][high >> 16 & 0xff] ^ tables[0][high >> 24];
}

}  // namespace

std::uint32_t crc32c_plain(std::string_view bytes, std::uint32_t crc) {
  const auto* p = reinterpret_cast<const unsigned char*>(bytes.data());
  const unsigned char* const end = p + bytes.size();
  std::uint32_t state = ~crc;
  for (; end - p >= 8; p += 8) state = eight_bytes(state, p);
  for (; p != end; ++p) state = (state >> 8) ^ tables[0][(state ^ *p) & 0xff];
  return ~state;
}

#if defined(__x86_64__)

bool has_crc_instruction() { return __builtin_cpu_supports("sse4.2") != 0; }

__attribute__((target("sse4.2"))) std::uint32_t crc32c_by_instruction(std::string_view bytes, std::uint32_t crc) {
  const char* p = bytes.data();
  const char* const end = p + bytes.size();
  std::uint64_t state = ~crc;
  for (; end - p >= 8; p += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, p, 8);
    state = _mm_crc32_u64(state, eight);
  }
  auto narrow = static_cast<std::uint32_t>(state);
  for (; p != end; ++p) narrow = _mm_crc32_u8(narrow, static_cast<unsigned char>(*p));
  return ~narrow;
}

#else

bool has_crc_instruction() { return false; }
std::uint32_t crc32c_by_instruction(std::string_view bytes, std::uint32_t crc) { return crc32c_plain(bytes, crc); }

#endif

std::uint32_t crc32c(std::string_view bytes, std::uint32_t crc) {
  static const bool by_instruction = has_crc_instruction();
  return by_instruction ? crc32c_by_instruction(bytes, crc) : crc32c_plain(bytes, crc);
}

}  // namespace noli
