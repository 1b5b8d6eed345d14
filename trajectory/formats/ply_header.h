// SPDX-License-Identifier: Apache-2.0
//
// Parses the header of a PLY file, which says what the body holds, element by element.
//
// Grammar, one line each (LF or CRLF), words separated by blanks:
//   ply | format (ascii|binary_little_endian|binary_big_endian) 1.0 | comment ... | obj_info ...
//   element NAME COUNT | property TYPE NAME | property list COUNT_TYPE TYPE NAME | end_header
// TYPE is char uchar short ushort int uint float double, or int8 uint8 int16 uint16 int32 uint32 int64 uint64 float32
// float64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace noli {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Bytes of a value in a binary body.
std::size_t size_of(PlyType type);
constexpr bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float64;    ///< of the value, or of the items of the list
  std::optional<PlyType> count_type;  ///< of the length of the list, always an integer type; absent when it is no list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t line = 0;  ///< of the header, where it is declared

  /// The property of that name, nullptr when there is none.
  const PlyProperty* find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;  ///< in the order of the body
  std::size_t body_offset = 0;       ///< byte at which the body begins
  std::size_t body_line = 0;         ///< number of the first line of an ASCII body

  /// The element of that name, nullptr when there is none.
  const PlyElement* find(std::string_view element) const;
};

/// The types of x, y and z of element vertex, with their numbers of bits, each once, in that order: "float32",
/// "float32/float64".
std::string number_type(const PlyElement& vertex);

/// Parses the header at the beginning of `bytes`; errors name `file`. Allocates in proportion to the header's own
/// length, whatever counts it promises. Throws InputError with the line: not a PLY file, no end_header, an unknown
/// format, keyword or type, a count that is not a number, a name declared twice, an element that has entries but no
/// properties.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& file);

}  // namespace noli
