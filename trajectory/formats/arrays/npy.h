// SPDX-License-Identifier: Apache-2.0
//
// Arrays as numpy writes them: `.npy`, format versions 1 to 3 (numpy/lib/format.py), of integers or of float32 and
// float64 in either byte order, in the order of C or of Fortran.
//
// What this does not do: it unpickles nothing. Arrays of objects, strings, records and complex numbers are refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trajectory/formats/arrays/byte_stream.h"

namespace noli {

struct NpyHeader {
  enum class Kind : std::uint8_t { real, signed_integer, unsigned_integer, other };

  Kind kind = Kind::real;
  std::size_t size = 8;  ///< bytes of a number: 4 or 8 of a real one, 1, 2, 4 or 8 of an integer
  bool big_endian = false;
  bool fortran = false;  ///< the first index runs fastest
  std::vector<std::uint64_t> shape;
  std::uint64_t header_bytes = 0;  ///< before the first number
  std::string refusal;             ///< why numbers of this type are not read; empty: they are

  std::uint64_t count() const;                                           ///< of numbers; below 2^60
  std::uint64_t bytes() const { return header_bytes + count() * size; }  ///< of a type that is read
  std::string type() const;                                              ///< "float64", "int32"
  std::string text() const;                                              ///< "float64 (60, 4, 3)"
};

/// Reads the header of the array that begins here; nothing at the end of the stream. `name`: what errors call it.
/// Throws InputError.
std::optional<NpyHeader> read_npy_header(ByteStream& bytes, const std::string& name);

/// The next numbers, without rounding. Throws InputError where the stream ends before them. Precondition: the kind is
/// real; or it is not, and numbers fit (uint64 up to 2^63 - 1, else InputError).
void read_numbers(ByteStream& bytes, const NpyHeader& header, const std::string& name, std::span<double> numbers);
void read_numbers(ByteStream& bytes, const NpyHeader& header, const std::string& name, std::span<std::int64_t> numbers);

/// The header of an array in this machine's byte order and the order of C, format version 1. Precondition: real or
/// unsigned.
std::string npy_header(NpyHeader::Kind kind, std::size_t size, std::span<const std::uint64_t> shape);

/// Throws InputError unless the stream ends here. An archive checks the sum of a member where it ends.
void require_end(ByteStream& bytes, const std::string& name);

/// Leaves out that many numbers.
void skip_numbers(ByteStream& bytes, const NpyHeader& header, const std::string& name, std::uint64_t count);

}  // namespace noli
