// SPDX-License-Identifier: Apache-2.0
//
// The stream of messages through which the program noli_series gets arrays, on its standard input.
//
//   stream  =  "noli series"  version  message*  end
//   array   =  1  type  name  unit  dimensions  length*       the next array, numbered from 0
//   values  =  2  array  first  count  value*                 from value number `first` on, the last index first
//   end     =  3                                              nothing follows
//
// All are u64, little-endian, except the eleven letters at the beginning and the texts: a text is its length and its
// bytes. A value is eight bytes: f64 (type 0) or a signed integer (type 1).
//
// Values come in pieces: a message has whole rows (a row is everything with one first index), or a part of one row that
// is whole in all indices after the second. Each value comes once; the writer chooses the order.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trajectory/blocks/bytes.h"

namespace noli::series {

inline constexpr std::string_view letters = "noli series";
inline constexpr std::uint64_t version = 1;

enum class Message : std::uint64_t { array = 1, values = 2, end = 3 };
enum class Type : std::uint64_t { f64 = 0, i64 = 1 };

/// Number of entries along each dimension, the one that varies slowest first.
using Shape = std::vector<std::uint64_t>;

struct Array {
  Type type = Type::f64;
  std::string name;  ///< "energy/kinetic" is an array in a group
  std::string unit;  ///< SI; "1" for a pure number
  Shape shape;
};

// Limits of the program.
inline constexpr std::uint64_t most_letters = 256;   ///< of a name or a unit
inline constexpr std::uint64_t most_dimensions = 8;  ///< at least one
inline constexpr std::uint64_t most_arrays = 4096;
inline constexpr std::uint64_t most_in_a_piece = 1 << 17;  ///< values
inline constexpr std::uint64_t most_values = std::uint64_t{1} << 56;

/// The product of the lengths from `dimension` on. Saturates at 2^64 - 1.
inline std::uint64_t product_from(const Shape& shape, std::size_t dimension) {
  std::uint64_t product = 1;
  for (std::size_t i = dimension; i < shape.size(); ++i) {
    if (__builtin_mul_overflow(product, shape[i], &product)) product = ~std::uint64_t{0};
  }
  for (std::size_t i = dimension; i < shape.size(); ++i) product = shape[i] == 0 ? 0 : product;
  return product;
}

inline void put_text(std::string& out, std::string_view text) {
  put(out, std::uint64_t{text.size()});
  out += text;
}

inline void put_beginning(std::string& out) {
  out += letters;
  put(out, version);
}

inline void put_array(std::string& out, const Array& array) {
  put(out, static_cast<std::uint64_t>(Message::array));
  put(out, static_cast<std::uint64_t>(array.type));
  put_text(out, array.name);
  put_text(out, array.unit);
  put(out, std::uint64_t{array.shape.size()});
  for (const std::uint64_t length : array.shape) put(out, length);
}

/// Writes the part of a message before its values.
inline void put_values(std::string& out, std::uint64_t array, std::uint64_t first, std::uint64_t count) {
  put(out, static_cast<std::uint64_t>(Message::values));
  put(out, array);
  put(out, first);
  put(out, count);
}

inline void put_end(std::string& out) { put(out, static_cast<std::uint64_t>(Message::end)); }

}  // namespace noli::series
