// SPDX-License-Identifier: Apache-2.0
//
// Reads the stream of stream.h from a descriptor. What is not as it says ends the program (ending.h); no length is
// believed before it has been compared with what the program takes.
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
  /// Reads its beginning.
  explicit StreamReader(int descriptor);

  Message next_message();
  Array array();
  /// Of one of the arrays, whole rows of it or a part of one.
  Piece piece(std::span<const Array> arrays);
  /// `count` values of eight bytes, in the machine's order of bytes. They are there until the next call.
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
  std::size_t begin_ = 0, end_ = 0;  ///< of what is in the buffer
  std::vector<std::uint64_t> values_;
};

}  // namespace noli::series
