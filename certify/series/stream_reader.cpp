// SPDX-License-Identifier: Apache-2.0
#include "certify/series/stream_reader.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "certify/series/ending.h"

namespace noli::series {
namespace {

constexpr std::size_t buffer_size = 1 << 16;

void require(bool holds, const std::string& problem) {
  if (!holds) end_with(Ending::bad_input, "the stream: " + problem);
}

/// Requires that a piece has the shape that stream.h demands.
void require_piece(const Array& array, const Piece& piece) {
  const std::uint64_t all = product_from(array.shape, 0), row = product_from(array.shape, 1);
  require(piece.first <= all && piece.count <= all - piece.first, "values beyond the array " + array.name);
  const std::uint64_t inner = product_from(array.shape, 2);
  const bool rows = piece.first % row == 0 && piece.count % row == 0;
  const bool in_a_row = piece.first % inner == 0 && piece.count % inner == 0 && piece.count <= row - piece.first % row;
  require(rows || in_a_row, "neither rows of the array " + array.name + " nor a part of one");
}

}  // namespace

StreamReader::StreamReader(int descriptor) : descriptor_(descriptor), buffer_(buffer_size) {
  std::string beginning(letters.size(), '\0');
  read(beginning.data(), beginning.size());
  require(beginning == letters, "expected to begin with \"noli series\"");
  const std::uint64_t found = number();
  require(found == version, "version " + std::to_string(found) + "; expected 1");
}

void StreamReader::read(char* bytes, std::size_t count) {
  while (count > 0) {
    if (begin_ == end_) {
      const ssize_t got = ::read(descriptor_, buffer_.data(), buffer_.size());
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) end_lost(errno);
      require(got > 0, "ends too early");
      begin_ = 0;
      end_ = static_cast<std::size_t>(got);
    }
    const std::size_t here = std::min(count, end_ - begin_);
    std::memcpy(bytes, buffer_.data() + begin_, here);
    begin_ += here;
    bytes += here;
    count -= here;
  }
}

std::uint64_t StreamReader::number() {
  char bytes[sizeof(std::uint64_t)];
  read(bytes, sizeof(bytes));
  return get<std::uint64_t>(bytes);
}

std::uint64_t StreamReader::number_up_to(std::uint64_t most, const char* what) {
  const std::uint64_t found = number();
  require(found <= most,
          std::string(what) + " " + std::to_string(found) + "; expected at most " + std::to_string(most));
  return found;
}

std::string StreamReader::text(const char* what) {
  std::string text(number_up_to(most_letters, what), '\0');
  read(text.data(), text.size());
  require(text.find('\0') == std::string::npos, std::string(what) + " with a zero byte");
  return text;
}

Message StreamReader::next_message() {
  const std::uint64_t kind = number();
  require(1 <= kind && kind <= 3, "message " + std::to_string(kind) + "; expected 1, 2 or 3");
  return static_cast<Message>(kind);
}

Array StreamReader::array() {
  Array array;
  array.type = static_cast<Type>(number_up_to(1, "a type"));
  array.name = text("the length of a name");
  array.unit = text("the length of a unit");
  const std::uint64_t dimensions = number_up_to(most_dimensions, "a number of dimensions");
  require(dimensions > 0, "an array without dimensions");
  for (std::uint64_t i = 0; i < dimensions; ++i) array.shape.push_back(number());
  require(product_from(array.shape, 0) <= most_values, "the array " + array.name + " is too large");
  return array;
}

Piece StreamReader::piece(std::span<const Array> arrays) {
  Piece piece;
  piece.array = number();
  require(piece.array < arrays.size(), "values of array " + std::to_string(piece.array) + ", which is not there");
  piece.first = number();
  piece.count = number_up_to(most_in_a_piece, "a piece of");
  require(piece.count > 0, "an empty piece");
  require_piece(arrays[piece.array], piece);
  return piece;
}

const void* StreamReader::values(std::uint64_t count) {
  values_.resize(count);
  read(reinterpret_cast<char*>(values_.data()), count * sizeof(std::uint64_t));
  for (std::uint64_t& value : values_) value = get<std::uint64_t>(reinterpret_cast<const char*>(&value));
  return values_.data();
}

void StreamReader::require_end() {
  char byte = 0;
  ssize_t got = 0;
  while ((got = begin_ < end_ ? 1 : ::read(descriptor_, &byte, 1)) < 0 && errno == EINTR) {
  }
  if (got < 0) end_lost(errno);
  require(got == 0, "continues after its end");
}

}  // namespace noli::series
