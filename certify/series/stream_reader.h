// SPDX-License-Identifier: Apache-2.0
//
// Reads the stream of stream.h from a descriptor. A malformed stream ends the program (ending.h). Lengths are compared
// with the limits of the program before they are used.
#pragma once

#include <span>
#include <vector>

#include "certify/series/stream.h"

namespace noli::series {

/// A piece of an array.
struct Piece {
  std::uint64_t array = 0, first = 0, count = 0;
};

class StreamReader {
 public:
  /// Reads the beginning of the stream.
  explicit StreamReader(int descriptor);

  Message next_message();
  Array array();
  /// A piece of one of the arrays: whole rows, or a part of one row.
  Piece piece(std::span<const Array> arrays);
  /// `count` values of eight bytes, in the machine's byte order. Valid until the next call.
  const void* values(std::uint64_t count);
  /// Nothing may follow.
  void require_end();

 private:
  void read(char* bytes, std::size_t count);
  std::uint64_t number();
  std::uint64_t number_up_to(std::uint64_t most, const char* what);
  std::string text(const char* what);

  int descriptor_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of the bytes in the buffer
  std::vector<std::uint64_t> values_;
};

}  // namespace noli::series
