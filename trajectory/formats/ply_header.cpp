// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/ply_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

#include <noli/errors.h>
#include "trajectory/text.h"

namespace noli {
namespace {

struct TypeName {
  std::string_view word;
  PlyType type;
};
constexpr std::array<TypeName, 18> type_names = {{{"int8", PlyType::int8},
                                                  {"uint8", PlyType::uint8},
                                                  {"int16", PlyType::int16},
                                                  {"uint16", PlyType::uint16},
                                                  {"int32", PlyType::int32},
                                                  {"uint32", PlyType::uint32},
                                                  {"int64", PlyType::int64},
                                                  {"uint64", PlyType::uint64},
                                                  {"float32", PlyType::float32},
                                                  {"float64", PlyType::float64},
                                                  {"char", PlyType::int8},
                                                  {"uchar", PlyType::uint8},
                                                  {"short", PlyType::int16},
                                                  {"ushort", PlyType::uint16},
                                                  {"int", PlyType::int32},
                                                  {"uint", PlyType::uint32},
                                                  {"float", PlyType::float32},
                                                  {"double", PlyType::float64}}};

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file), lines_(bytes) {}

  PlyHeader parse() {
    std::string_view line;
    if (!lines_.next(line) || line != "ply")
      throw InputError(file_, line_place(1), "expected 'ply', this is not a PLY file");
    while (true) {
      if (!lines_.next(line))
        throw InputError(file_, line_place(lines_.number()), "the header ends without 'end_header'");
      if (line == "end_header") break;
      parse_line(line);
    }
    finish_element();
    if (!format_seen_) fail("the header has no 'format' line");
    header_.body_offset = bytes_.size() - lines_.rest().size();
    header_.body_line = lines_.number() + 1;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_, line_place(lines_.number()), problem);
  }

  void parse_line(std::string_view line) {
    Words words(line);
    const std::string_view keyword = words.next();
    if (keyword == "comment" || keyword == "obj_info") return;
    if (keyword == "format") {
      parse_format(words);
    } else if (keyword == "element") {
      parse_element(words);
    } else if (keyword == "property") {
      parse_property(words);
    } else {
      fail(fmt::format("expected format, element, property, comment, obj_info or end_header, found {}",
                       in_quotes(line)));
    }
    if (!words.at_end()) fail(fmt::format("expected the end of the line, found {}", in_quotes(words.next())));
  }

  void parse_format(Words& words) {
    if (format_seen_) fail("a second 'format' line");
    format_seen_ = true;
    const std::string_view word = words.next();
    if (word == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (word == "binary_little_endian") {
      header_.format = PlyFormat::binary_little_endian;
    } else if (word == "binary_big_endian") {
      header_.format = PlyFormat::binary_big_endian;
    } else {
      fail(fmt::format("expected ascii, binary_little_endian or binary_big_endian, found {}", in_quotes(word)));
    }
    const std::string_view version = words.next();
    if (version != "1.0") fail(fmt::format("expected version 1.0, found {}", in_quotes(version)));
  }

  void parse_element(Words& words) {
    finish_element();
    PlyElement element;
    element.name = words.next();
    element.line = lines_.number();
    if (element.name.empty()) fail("expected the name of an element");
    if (!element_names_.insert(element.name).second) fail(fmt::format("a second element {}", in_quotes(element.name)));
    const std::string_view count = words.next();
    if (parse_number(count, element.count) != std::errc{}) {
      fail(fmt::format("expected the number of entries of {}, found {}", in_quotes(element.name), in_quotes(count)));
    }
    header_.elements.push_back(std::move(element));
    property_names_.clear();
  }

  void parse_property(Words& words) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    std::string_view type = words.next();
    if (type == "list") {
      property.count_type = parse_type(words.next());
      if (!is_integer(*property.count_type)) fail("expected an integer type for the length of a list");
      type = words.next();
    }
    property.type = parse_type(type);
    property.name = words.next();
    if (property.name.empty()) fail("expected the name of a property");
    if (!property_names_.insert(property.name).second) {
      fail(fmt::format("a second property {} in element {}", in_quotes(property.name),
                       in_quotes(header_.elements.back().name)));
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType parse_type(std::string_view word) const {
    const auto* const found = std::ranges::find(type_names, word, &TypeName::word);
    if (found == type_names.end())
      fail(fmt::format("expected a type such as uchar, int, float or double, found {}", in_quotes(word)));
    return found->type;
  }

  /// An entry without properties takes no bytes, so a header could promise any number of them.
  void finish_element() const {
    if (header_.elements.empty()) return;
    const PlyElement& element = header_.elements.back();
    if (element.count > 0 && element.properties.empty()) {
      throw InputError(file_, line_place(element.line),
                       fmt::format("element {} has no properties", in_quotes(element.name)));
    }
  }

  std::string_view bytes_;
  const std::string& file_;
  Lines lines_;
  PlyHeader header_;
  bool format_seen_ = false;
  std::set<std::string> element_names_;
  std::set<std::string> property_names_;  ///< of the element that is being declared
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32: return 4;
    case PlyType::int64:
    case PlyType::uint64:
    case PlyType::float64: return 8;
  }
  return 0;
}

const PlyProperty* PlyElement::find(std::string_view property) const {
  const auto found = std::ranges::find(properties, property, &PlyProperty::name);
  return found == properties.end() ? nullptr : &*found;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  const auto found = std::ranges::find(elements, element, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

std::string number_type(const PlyElement& vertex) {
  std::vector<std::string_view> types;
  for (const std::string_view axis : {"x", "y", "z"}) {
    const PlyProperty* property = vertex.find(axis);
    if (property == nullptr) continue;
    const std::string_view type = std::ranges::find(type_names, property->type, &TypeName::type)->word;
    if (std::ranges::find(types, type) == types.end()) types.push_back(type);
  }
  return fmt::format("{}", fmt::join(types, "/"));
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& file) {
  return HeaderParser(bytes, file).parse();
}

}  // namespace noli
