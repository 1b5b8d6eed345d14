// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/vtk/vtk_xml.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <type_traits>

#include <noli/errors.h>
#include "trajectory/blocks/bytes.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

struct Damaged {
  std::string problem;
};

/// Bytes of an array, from wherever it has them.
class ArrayBytes {
 public:
  ArrayBytes(std::string_view from, bool base64) : rest_(from), base64_(base64) {}

  /// Throws Damaged when there are not so many.
  std::string take(std::uint64_t count) {
    if (count > most_left()) throw Damaged{fmt::format("announces {} bytes, and has at most {}", count, most_left())};
    if (!base64_) {
      std::string bytes(rest_.substr(0, count));
      rest_.remove_prefix(count);
      return bytes;
    }
    std::string bytes;
    bytes.reserve(count);
    while (bytes.size() < count) {
      if (waiting_.empty()) {
        end_if_stopped();
        decode_part();
      }
      const std::size_t part = std::min<std::size_t>(waiting_.size(), count - bytes.size());
      bytes.append(waiting_, 0, part);
      waiting_.erase(0, part);
    }
    return bytes;
  }

 private:
  std::uint64_t most_left() const { return base64_ ? waiting_.size() + rest_.size() / 4 * 3 : rest_.size(); }

  /// Four letters are three bytes. Padding ends a stream, and another one may follow.
  void decode_part() {
    constexpr std::size_t most = 4096;
    while (waiting_.size() < most) {
      std::uint32_t bits = 0;
      int letters = 0, padding = 0;
      while (letters < 4) {
        while (!rest_.empty() && (is_blank(rest_.front()) || rest_.front() == '\n' || rest_.front() == '\r')) {
          rest_.remove_prefix(1);
        }
        if (rest_.empty()) break;
        const int value = value_of(rest_.front());
        if (value == pad) ++padding;
        if (value == none || (padding > 0 && value != pad)) throw Damaged{"has a character that is not base64"};
        bits = bits << 6 | static_cast<std::uint32_t>(value == pad ? 0 : value);
        rest_.remove_prefix(1);
        ++letters;
      }
      if (letters == 0) break;
      if (letters < 4 || padding > 2) throw Damaged{"ends within a group of base64"};
      for (int i = 0; i < 3 - padding; ++i) waiting_ += static_cast<char>(bits >> (16 - 8 * i) & 0xff);
    }
    if (waiting_.empty()) throw Damaged{"ends before its last byte"};
  }

  static constexpr int pad = 64, none = 65;
  static int value_of(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    if (c == '/') return 63;
    return c == '=' ? pad : none;
  }

  std::string_view rest_;
  bool base64_;
  std::string waiting_;  ///< decoded, not taken yet
};

/// Deflate makes at most 1032 bytes of one.
std::string inflated(const std::string& deflated, std::uint64_t size) {
  constexpr std::uint64_t most_fold = 1032;
  if (size > most_fold * (deflated.size() + 1)) throw Damaged{"announces more bytes than zlib can have put there"};
  std::string bytes(size, 0);
  uLongf length = size;
  const int code = ::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                                reinterpret_cast<const Bytef*>(deflated.data()), deflated.size());
  if (code != Z_OK || length != size) throw Damaged{"has a block that zlib refuses"};
  return bytes;
}

}  // namespace

VtkXml::VtkXml(std::string_view bytes, std::string file, std::span<const std::string_view> types)
    : file_(std::move(file)), file_bytes_(bytes.size()) {
  // What is appended may be raw, and then is no XML.
  const std::size_t at = bytes.find("<AppendedData");
  std::string xml(bytes.substr(0, at));
  if (at != std::string_view::npos) {
    const std::size_t end = bytes.find('>', at), underscore = bytes.find('_', end);
    if (underscore == std::string_view::npos) throw InputError(file_, "", "has appended data without a beginning");
    appended_raw_ = bytes.substr(at, end - at).find("base64") == std::string_view::npos;
    appended_ = bytes.substr(underscore + 1);
    if (const std::size_t close = appended_.rfind("</AppendedData"); close != std::string_view::npos) {
      appended_ = appended_.substr(0, close);
    }
    xml += "</VTKFile>";
  }
  const pugi::xml_parse_result result =
      document_.load_buffer(xml.data(), xml.size(), pugi::parse_default | pugi::parse_comments, pugi::encoding_utf8);
  if (!result)
    throw InputError(file_, byte_place(static_cast<std::size_t>(result.offset)),
                     std::string("is not XML: ") + result.description());
  const pugi::xml_node root = document_.child("VTKFile");
  const std::string type = root.attribute("type").value();
  if (!root || std::ranges::find(types, type) == types.end()) {
    throw InputError(
        file_, "",
        fmt::format("is not a VTKFile of type {}{}", types.front(), root ? ", but of type " + in_quotes(type) : ""));
  }
  big_endian_ = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
  long_headers_ = std::string_view(root.attribute("header_type").value()) == "UInt64";
  const std::string_view compressor = root.attribute("compressor").value();
  compressed_ = !compressor.empty();
  if (compressed_ && compressor != "vtkZLibDataCompressor") {
    throw InputError(
        file_, "", fmt::format("is compressed by {}; expected vtkZLibDataCompressor, or none", in_quotes(compressor)));
  }
  content_ = only(root, type.c_str());
  if (!content_) throw InputError(file_, "", "has no element " + type);
}

void VtkXml::fail(const pugi::xml_node& where, const std::string& problem) const {
  const std::string name = where.attribute("Name").value();
  throw InputError(file_, name.empty() ? where.name() : fmt::format("{} {}", where.name(), in_quotes(name)), problem);
}

pugi::xml_node VtkXml::only(const pugi::xml_node& parent, const char* name) const {
  const pugi::xml_node first = parent.child(name);
  if (first && first.next_sibling(name)) fail(parent, fmt::format("has two elements {}; expected one", name));
  return first;
}

std::string VtkXml::type_of(const pugi::xml_node& array) const { return array.attribute("type").value(); }

bool VtkXml::is_text(const pugi::xml_node& array) const {
  const std::string_view format = array.attribute("format").value();
  return format.empty() || format == "ascii";
}

/// A comment or element within would divide it, and a part be missed.
std::string_view VtkXml::text_of(const pugi::xml_node& array) const {
  std::string_view text;
  for (const pugi::xml_node part : array.children()) {
    const bool key = part.type() == pugi::node_element && std::string_view(part.name()) == "InformationKey";
    if (key || part.type() == pugi::node_comment) continue;
    if (part.type() != pugi::node_pcdata || !text.empty()) {
      fail(array, "has more than one text in it; expected only numbers");
    }
    text = part.value();
  }
  return text;
}

std::string VtkXml::bytes_of(const pugi::xml_node& array) const {
  const std::string_view format = array.attribute("format").value();
  const bool appended = format == "appended";
  if (!appended && format != "binary")
    fail(array, "has the format " + in_quotes(format) + "; expected ascii, binary or appended");
  std::string_view from = text_of(array);
  if (appended) {
    std::uint64_t offset = 0;
    if (parse_number(std::string_view(array.attribute("offset").value()), offset) != std::errc{} ||
        offset > appended_.size()) {
      fail(array, "has no offset within the appended data");
    }
    from = appended_.substr(offset);
  }
  try {
    ArrayBytes bytes(from, !appended || !appended_raw_);
    const auto header = [&] {
      const std::string raw = bytes.take(long_headers_ ? 8 : 4);
      return long_headers_ ? number_from_bytes<std::uint64_t>(raw.data(), big_endian_)
                           : number_from_bytes<std::uint32_t>(raw.data(), big_endian_);
    };
    // Real coordinates do not shrink to a hundredth.
    constexpr std::uint64_t small = std::uint64_t{1} << 28, most_fold = 100;
    const auto count = [&](std::uint64_t more) {
      unpacked_ += more;
      if (unpacked_ < more || unpacked_ > small + most_fold * file_bytes_) {
        throw Damaged{"unpacks to more than a hundred times the file"};
      }
    };
    if (!compressed_) {
      const std::uint64_t length = header();
      std::string all = bytes.take(length);
      count(all.size());
      return all;
    }
    const std::uint64_t blocks = header(), size = header(), last = header();
    if (blocks > from.size()) throw Damaged{fmt::format("announces {} compressed blocks", blocks)};
    std::vector<std::uint64_t> sizes;
    for (std::uint64_t i = 0; i < blocks; ++i) sizes.push_back(header());
    std::string all;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      end_if_stopped();
      const std::uint64_t unpacked = i + 1 == blocks && last > 0 ? last : size;
      count(unpacked);
      all += inflated(bytes.take(sizes[i]), unpacked);
    }
    return all;
  } catch (const Damaged& damaged) {
    fail(array, damaged.problem);
  }
}

template <class From>
From VtkXml::number_of(std::string_view word, const pugi::xml_node& array, std::size_t position) const {
  From value{};
  if constexpr (std::is_floating_point_v<From>) {
    const std::string problem = parse_finite(word, value);
    if (!problem.empty()) fail(array, fmt::format("number {}: {}", position, problem));
    return value;
  }
  bool is_one = false;
  if constexpr (sizeof(From) == 1) {  // std::from_chars would take a letter
    int number = 0;
    is_one = parse_number(word, number) == std::errc{} && number == static_cast<int>(static_cast<From>(number));
    value = static_cast<From>(number);
  } else {
    is_one = parse_number(word, value) == std::errc{};
  }
  if (!is_one) {
    fail(array, fmt::format("number {}: expected one of type {}, found {}", position, type_of(array), in_quotes(word)));
  }
  return value;
}

template <class From, class Number>
std::vector<Number> VtkXml::from_text(const pugi::xml_node& array) const {
  std::vector<Number> result;
  const std::string_view text = text_of(array);
  constexpr std::string_view blanks = " \t\r\n";
  for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    if (result.size() % 4096 == 0) end_if_stopped();
    result.push_back(static_cast<Number>(number_of<From>(text.substr(begin, end - begin), array, result.size())));
    begin = text.find_first_not_of(blanks, end);
  }
  return result;
}

template <class From, class Number>
std::vector<Number> VtkXml::converted(const pugi::xml_node& array) const {
  if (is_text(array)) return from_text<From, Number>(array);
  std::vector<Number> result;
  const std::string bytes = bytes_of(array);
  if (bytes.size() % sizeof(From) != 0)
    fail(array, fmt::format("has {} bytes, not a multiple of {}", bytes.size(), sizeof(From)));
  result.reserve(bytes.size() / sizeof(From));
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(From)) {
    if (at % (std::size_t{1} << 16) == 0) end_if_stopped();
    const auto value = number_from_bytes<From>(bytes.data() + at, big_endian_);
    if constexpr (std::is_same_v<From, std::uint64_t>) {
      if (value > std::uint64_t{INT64_MAX}) fail(array, fmt::format("has the number {}", value));
    }
    result.push_back(static_cast<Number>(value));
  }
  return result;
}

std::vector<double> VtkXml::reals(const pugi::xml_node& array) const {
  const std::string type = type_of(array);
  if (type == "Float64") return converted<double, double>(array);
  if (type == "Float32") return converted<float, double>(array);
  fail(array, "has the type " + in_quotes(type) + "; expected Float32 or Float64");
}

std::vector<std::int64_t> VtkXml::integers(const pugi::xml_node& array) const {
  const std::string type = type_of(array);
  if (type == "Int64") return converted<std::int64_t, std::int64_t>(array);
  if (type == "Int32") return converted<std::int32_t, std::int64_t>(array);
  if (type == "Int16") return converted<std::int16_t, std::int64_t>(array);
  if (type == "Int8") return converted<std::int8_t, std::int64_t>(array);
  if (type == "UInt64") return converted<std::uint64_t, std::int64_t>(array);
  if (type == "UInt32") return converted<std::uint32_t, std::int64_t>(array);
  if (type == "UInt16") return converted<std::uint16_t, std::int64_t>(array);
  if (type == "UInt8") return converted<std::uint8_t, std::int64_t>(array);
  fail(array, "has the type " + in_quotes(type) + "; expected integers");
}

}  // namespace noli
