// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens.h"

namespace noli {

void put_uint(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<char>(value | 0x80));
  bytes.push_back(static_cast<char>(value));
}

void put_sint(std::string& bytes, const Integer& value) {
  Integer coded = value.sign() < 0 ? -value * Integer(2) - Integer(1) : value * Integer(2);
  do {
    const auto low = static_cast<std::uint8_t>(mpz_get_ui(coded.get()) & 0x7f);
    coded >>= 7;
    bytes.push_back(static_cast<char>(coded.is_zero() ? low : low | 0x80));
  } while (!coded.is_zero());
}

void Tokens::direction(const std::array<int, 3>& n) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 3; ++k) word |= (static_cast<std::uint32_t>(n[k]) & 0x3ff) << (10 * k);
  std::string& bytes = room();
  bytes.push_back(0x10);
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(word >> (8 * i)));
}

void Tokens::direction(const std::array<Integer, 3>& n) {
  std::string& bytes = room();
  bytes.push_back(0x11);
  for (const Integer& part : n) put_sint(bytes, part);
}

void Tokens::ring(VertexId v, const std::vector<std::array<std::uint32_t, 2>>& steps) {
  std::string& bytes = room();
  bytes.push_back(0x30);
  put_uint(bytes, steps.size());
  put_uint(bytes, v);
  for (const auto& [cell, next] : steps) {
    put_uint(bytes, cell);
    put_uint(bytes, next);
  }
}

}  // namespace noli
