// SPDX-License-Identifier: Apache-2.0
//
// A number from its bytes in a file, in either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace noli {

/// An integer, float or double. Precondition: `bytes` has at least sizeof(Number).
template <class Number>
Number number_from_bytes(const char* bytes, bool big_endian) {
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), bytes, sizeof(Number));
  if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
  return std::bit_cast<Number>(raw);
}

}  // namespace noli
