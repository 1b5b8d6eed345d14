// SPDX-License-Identifier: Apache-2.0
//
// The XML files of VTK, and the numbers in their DataArray elements: as text, in base64, or appended behind the XML in
// base64 or raw; in either byte order, with lengths of 32 or 64 bits, compressed with zlib or not. (VTK User's Guide,
// "VTK XML file formats".)
//
// What this does not do: it expands no entities beyond those of XML itself, and fetches nothing. Lengths are compared
// with the bytes that are there before anything is allocated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace noli {

class VtkXml {
 public:
  /// `bytes` has to outlive this. Throws InputError for what is no VTKFile of one of these types.
  VtkXml(std::string_view bytes, std::string file, std::span<const std::string_view> types);

  /// The element of its type, which the file is about.
  pugi::xml_node content() const { return content_; }
  const std::string& file() const { return file_; }
  [[noreturn]] void fail(const pugi::xml_node& where, const std::string& problem) const;

  /// "Float64", ...: of a DataArray.
  std::string type_of(const pugi::xml_node& array) const;
  /// The only element of this name; none if there is none. Throws InputError for two of them.
  pugi::xml_node only(const pugi::xml_node& parent, const char* name) const;
  /// Whether its numbers are text; that text.
  bool is_text(const pugi::xml_node& array) const;
  std::string_view text_of(const pugi::xml_node& array) const;

  /// Its numbers, without rounding but that of decimal text. Throws InputError: other types, damage.
  std::vector<double> reals(const pugi::xml_node& array) const;
  std::vector<std::int64_t> integers(const pugi::xml_node& array) const;

 private:
  std::string bytes_of(const pugi::xml_node& array) const;
  /// The number that a word of an array is; `position`: which of them.
  template <class From>
  From number_of(std::string_view word, const pugi::xml_node& array, std::size_t position) const;
  template <class From, class Number>
  std::vector<Number> from_text(const pugi::xml_node& array) const;
  template <class From, class Number>
  std::vector<Number> converted(const pugi::xml_node& array) const;

  std::string file_;
  std::uint64_t file_bytes_ = 0;
  mutable std::uint64_t unpacked_ = 0;  ///< bytes of all arrays that were decoded so far
  std::string_view appended_;           ///< behind the underscore
  bool appended_raw_ = false, big_endian_ = false, long_headers_ = false, compressed_ = false;
  pugi::xml_document document_;
  pugi::xml_node content_;
};

}  // namespace noli
