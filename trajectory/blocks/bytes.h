// SPDX-License-Identifier: Apache-2.0
//
// Converts numbers to and from bytes: for block files little-endian on every machine, for other formats in either byte
// order. Doubles are their IEEE 754 binary64 bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include <noli/mesh.h>

namespace noli {

/// An unsigned integer or double.
template <class T>
concept PlainNumber = std::is_unsigned_v<T> || std::is_same_v<T, double>;

template <PlainNumber T>
void put(std::string& out, T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  out.append(bytes.data(), bytes.size());
}

/// Precondition: `bytes` has at least sizeof(T).
template <PlainNumber T>
T get(const char* bytes) {
  if constexpr (std::is_same_v<T, double>) {
    return std::bit_cast<double>(get<std::uint64_t>(bytes));
  } else {
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      value |= static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[i])) << (8 * i));
    return value;
  }
}

/// All numbers of an array, in one copy on little-endian machines.
template <PlainNumber T>
void put_all(std::string& out, std::span<const T> values) {
  if constexpr (std::endian::native == std::endian::little) {
    if (!values.empty()) out.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  } else {
    for (const T value : values) put(out, value);
  }
}

/// Precondition: `bytes` has at least values.size_bytes().
template <PlainNumber T>
void get_all(const char* bytes, std::span<T> values) {
  if constexpr (std::endian::native == std::endian::little) {
    if (!values.empty()) std::memcpy(values.data(), bytes, values.size_bytes());
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = get<T>(bytes + i * sizeof(T));
  }
}

/// An integer, float or double in a file of another format. Precondition: `bytes` has at least sizeof(Number).
template <class Number>
Number number_from_bytes(const char* bytes, bool big_endian) {
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), bytes, sizeof(Number));
  if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
  return std::bit_cast<Number>(raw);
}

/// The coordinates of all positions, one after another.
inline std::span<const double> coordinates(std::span<const Position> positions) {
  return {positions.empty() ? nullptr : positions.front().data(), 3 * positions.size()};
}

}  // namespace noli
