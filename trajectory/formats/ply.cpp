// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include <noli/errors.h>
#include "trajectory/blocks/bytes.h"
#include "trajectory/cells.h"
#include "trajectory/formats/ply_header.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

// --- The values of a body, one after another, from ASCII or from binary content --------------------------------------
//
// Both sources have the same interface; the reader is a template over them:
//   require_room(element)   fails when the remaining bytes cannot hold what the header promises
//   begin_entry(element, i), end_entry()
//   real(type)              a finite coordinate           integer(type)   a whole number
//   list_size(type, items)  a length that fits the rest   skip(type)      an unused value
//   finish()                fails when anything follows
//   fail(problem)           InputError at the value that was read last

/// Calls `f` with a value-initialised number of the C++ type that `type` stands for.
template <class F>
auto with_type(PlyType type, F&& f) {
  switch (type) {
    case PlyType::int8: return f(std::int8_t{});
    case PlyType::uint8: return f(std::uint8_t{});
    case PlyType::int16: return f(std::int16_t{});
    case PlyType::uint16: return f(std::uint16_t{});
    case PlyType::int32: return f(std::int32_t{});
    case PlyType::uint32: return f(std::uint32_t{});
    case PlyType::int64: return f(std::int64_t{});
    case PlyType::uint64: return f(std::uint64_t{});
    case PlyType::float32: return f(float{});
    case PlyType::float64: break;
  }
  return f(double{});
}

/// Whether an integer is exactly a double: at most 53 bits from its highest to its lowest set bit.
template <class T>
bool is_exactly_double(T value) {
  const auto magnitude =
      value < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
  return magnitude == 0 || std::bit_width(magnitude) - std::countr_zero(magnitude) <= 53;
}

/// The common part of both sources: names for errors, and the checks on a value that was read.
template <class Source>
class SourceBase {
 public:
  /// A coordinate: finite, and exactly a double.
  double real(PlyType type) {
    return with_type(type, [this](auto zero) {
      using T = decltype(zero);
      const T value = self().template value<T>();
      if constexpr (std::is_integral_v<T>) {
        if (!is_exactly_double(value)) self().fail(fmt::format("the integer {} is not exactly a double", value));
      } else {
        if (!std::isfinite(value)) self().fail(fmt::format("expected a finite number, found {}", value));
      }
      return static_cast<double>(value);
    });
  }

  /// Precondition: is_integer(type).
  std::int64_t integer(PlyType type) {
    return with_type(type, [this](auto zero) -> std::int64_t {
      using T = decltype(zero);
      if constexpr (std::is_integral_v<T>) {
        const T value = self().template value<T>();
        if (std::is_same_v<T, std::uint64_t> && value > static_cast<T>(std::numeric_limits<std::int64_t>::max())) {
          self().fail(fmt::format("the number {} is too large", value));
        }
        return static_cast<std::int64_t>(value);
      }
      return 0;
    });
  }

  /// Length of a list whose items take at least `item_bytes` bytes each.
  std::uint64_t list_size(PlyType type, std::uint64_t item_bytes) {
    const std::int64_t size = integer(type);
    if (size < 0) self().fail(fmt::format("expected the length of a list, found {}", size));
    if (static_cast<std::uint64_t>(size) > self().remaining() / item_bytes) {
      self().fail(fmt::format("truncated: a list of {} items, but only {} bytes remain", size, self().remaining()));
    }
    return static_cast<std::uint64_t>(size);
  }

 protected:
  /// Fails when the entries of an element, at least `bytes` bytes each, cannot fit into the remaining bytes plus
  /// `slack`.
  void require_bytes(const PlyElement& element, std::uint64_t bytes, std::uint64_t slack) {
    if (element.count > (self().remaining() + slack) / bytes) {
      self().fail(fmt::format(
          "truncated: the header promises {} entries of {}, at least {} bytes each, but only {} bytes remain",
          element.count, in_quotes(element.name), bytes, self().remaining()));
    }
  }

 private:
  Source& self() { return static_cast<Source&>(*this); }
};

template <std::endian Order>
class BinarySource : public SourceBase<BinarySource<Order>> {
 public:
  BinarySource(std::string_view bytes, const PlyHeader& header, const std::string& file)
      : bytes_(bytes), file_(file), at_(header.body_offset), last_(at_) {}

  static std::uint64_t item_bytes(PlyType type) { return size_of(type); }

  void require_room(const PlyElement& element) {
    last_ = at_;
    std::uint64_t bytes = 0;
    for (const PlyProperty& p : element.properties) bytes += size_of(p.count_type.value_or(p.type));
    if (element.count > 0) this->require_bytes(element, bytes, 0);
  }
  void begin_entry(const PlyElement& element, std::uint64_t entry) {
    element_ = &element;
    entry_ = entry;
  }
  void end_entry() {}

  template <class T>
  T value() {
    last_ = at_;
    if (remaining() < sizeof(T))
      fail(fmt::format("truncated: the file ends within entry {} of {}", entry_, in_quotes(element_->name)));
    at_ += sizeof(T);
    return number_from_bytes<T>(bytes_.data() + last_, Order == std::endian::big);
  }
  void skip(PlyType type) {
    with_type(type, [this](auto zero) { this->value<decltype(zero)>(); });
  }
  std::uint64_t remaining() const { return bytes_.size() - at_; }

  void finish() {
    last_ = at_;
    if (remaining() > 0) fail(fmt::format("expected the end of the file, found {} more bytes", remaining()));
  }
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(file_, byte_place(last_), problem); }

 private:
  std::string_view bytes_;
  const std::string& file_;
  std::size_t at_, last_;  ///< offsets of the next value and of the one before
  const PlyElement* element_ = nullptr;
  std::uint64_t entry_ = 0;
};

class AsciiSource : public SourceBase<AsciiSource> {
 public:
  AsciiSource(std::string_view bytes, const PlyHeader& header, const std::string& file)
      : file_(file), lines_(bytes.substr(header.body_offset), header.body_line), place_(header.body_line) {}

  static std::uint64_t item_bytes(PlyType) { return 2; }

  /// An entry is at least one byte and a line end; the last line end may be missing.
  void require_room(const PlyElement& element) { require_bytes(element, 2, 1); }
  void begin_entry(const PlyElement& element, std::uint64_t entry) {
    element_ = &element;
    std::string_view line;
    if (!next_filled_line(line)) {
      fail(fmt::format("truncated: the file ends before entry {} of {}", entry, in_quotes(element.name)));
    }
    words_ = Words(line);
    line_bytes_ = line.size();
  }
  void end_entry() {
    if (!words_.at_end()) {
      fail(fmt::format("expected the end of the line after an entry of {}, found {}", in_quotes(element_->name),
                       in_quotes(words_.next())));
    }
    line_bytes_ = 0;
  }

  template <class T>
  T value() {
    const std::string_view word = next_word();
    T result{};
    if constexpr (std::is_floating_point_v<T>) {
      if (const std::string problem = parse_finite(word, result); !problem.empty()) fail(problem);
    } else {
      const std::errc error = parse_number(word, result);
      if (error == std::errc::result_out_of_range)
        fail(fmt::format("{} does not fit the type declared in the header", in_quotes(word)));
      if (error != std::errc{}) fail(fmt::format("expected a whole number, found {}", in_quotes(word)));
    }
    return result;
  }
  void skip(PlyType) { next_word(); }
  /// Bytes that may still hold values: of the current line while it is being read, otherwise of the rest.
  std::uint64_t remaining() const { return line_bytes_ > 0 ? line_bytes_ + 1 : lines_.rest().size(); }

  void finish() {
    std::string_view line;
    if (next_filled_line(line)) fail(fmt::format("expected the end of the file, found {}", in_quotes(line)));
  }
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(file_, line_place(place_), problem); }

 private:
  bool next_filled_line(std::string_view& line) {
    line_bytes_ = 0;
    while (lines_.next(line)) {
      place_ = lines_.number();
      if (!Words(line).at_end()) return true;
    }
    return false;
  }
  std::string_view next_word() {
    const std::string_view word = words_.next();
    if (word.empty()) fail(fmt::format("the line ends within an entry of {}", in_quotes(element_->name)));
    return word;
  }

  const std::string& file_;
  Lines lines_;
  std::size_t place_;
  Words words_{std::string_view{}};
  std::size_t line_bytes_ = 0;  ///< of the line that is being read; 0 between lines
  const PlyElement* element_ = nullptr;
};

// --- The reader -----------------------------------------------------------------------------------------------------

/// Errors about the declaration of an element name its line in the header.
[[noreturn]] void fail_header(const std::string& file, const PlyElement& element, const std::string& problem) {
  throw InputError(file, line_place(element.line), problem);
}

const PlyProperty& require_scalar(const std::string& file, const PlyElement& element, std::string_view property) {
  const PlyProperty* found = element.find(property);
  if (found == nullptr || found->count_type) {
    fail_header(
        file, element,
        fmt::format("element {} has no property {} that is a number", in_quotes(element.name), in_quotes(property)));
  }
  return *found;
}

void require_integer(const std::string& file, const PlyElement& element, const PlyProperty& property) {
  if (!is_integer(property.type)) {
    fail_header(file, element, fmt::format("property {} must be of an integer type", in_quotes(property.name)));
  }
}

/// The list of vertices of element face, of which there must be exactly one.
const PlyProperty& require_corners(const std::string& file, const PlyElement& face) {
  const PlyProperty* plural = face.find("vertex_indices");
  const PlyProperty* singular = face.find("vertex_index");
  if (plural != nullptr && singular != nullptr)
    fail_header(file, face, "faces have both vertex_indices and vertex_index");
  const PlyProperty* corners = plural != nullptr ? plural : singular;
  if (corners == nullptr || !corners->count_type) {
    fail_header(file, face, "element 'face' has no list vertex_indices or vertex_index");
  }
  require_integer(file, face, *corners);
  return *corners;
}

/// Reads the body: every element entry by entry, property by property. Skips what is not needed.
template <class Source>
class BodyReader {
 public:
  BodyReader(std::string_view bytes, const PlyHeader& header, const std::string& file, Polygons* polygons)
      : source_(bytes, header, file), header_(header), file_(file), polygons_(polygons) {}

  Frame read() {
    const PlyElement* vertices = header_.find("vertex");
    if (vertices == nullptr) throw InputError(file_, "", "the header declares no element 'vertex'");
    if (vertices->count > std::numeric_limits<VertexId>::max()) {
      fail_header(file_, *vertices,
                  fmt::format("{} vertices are more than the 2^32 - 1 that indices can tell apart", vertices->count));
    }
    frame_.mesh.vertex_count = vertices->count;
    for (const PlyElement& element : header_.elements) {
      source_.require_room(element);
      if (element.count > 0) read_element(element);
    }
    source_.finish();
    drop_redundant_cells(frame_.mesh);
    return std::move(frame_);
  }

 private:
  void read_element(const PlyElement& element) {
    if (element.name == "tristrips")
      fail_header(file_, element, "triangle strips are not supported, expected element 'face'");
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") return read_faces(element);
    if (element.name == "edge") return read_edges(element);
    const auto skip_property = [this](const PlyProperty& property) { skip(property); };
    read_entries(element, skip_property, [] {});
  }

  /// Calls `read_property(property)` for each property of each entry, and `end_of_entry` after each entry.
  template <class ReadProperty, class EndOfEntry>
  void read_entries(const PlyElement& element, ReadProperty&& read_property, EndOfEntry&& end_of_entry) {
    for (std::uint64_t entry = 0; entry < element.count; ++entry) {
      end_if_stopped();
      source_.begin_entry(element, entry);
      for (const PlyProperty& property : element.properties) read_property(property);
      end_of_entry();
      source_.end_entry();
    }
  }

  void skip(const PlyProperty& property) {
    if (!property.count_type) return source_.skip(property.type);
    const std::uint64_t size = source_.list_size(*property.count_type, source_.item_bytes(property.type));
    for (std::uint64_t i = 0; i < size; ++i) source_.skip(property.type);
  }

  void read_vertices(const PlyElement& element) {
    const PlyProperty* x = &require_scalar(file_, element, "x");
    const PlyProperty* y = &require_scalar(file_, element, "y");
    const PlyProperty* z = element.find("z") == nullptr ? nullptr : &require_scalar(file_, element, "z");
    frame_.positions.reserve(element.count);
    Position position{};
    const auto read_property = [&](const PlyProperty& property) {
      if (&property == x) {
        position[0] = source_.real(property.type);
      } else if (&property == y) {
        position[1] = source_.real(property.type);
      } else if (&property == z) {
        position[2] = source_.real(property.type);
      } else {
        skip(property);
      }
    };
    read_entries(element, read_property, [&] { frame_.positions.push_back(position); });
  }

  void read_faces(const PlyElement& element) {
    const PlyProperty* corners = &require_corners(file_, element);
    frame_.mesh.faces.reserve(element.count);
    const auto read_property = [&](const PlyProperty& property) {
      if (&property == corners) {
        read_polygon(property);
      } else {
        skip(property);
      }
    };
    read_entries(element, read_property, [] {});
  }

  void read_polygon(const PlyProperty& corners) {
    const std::uint64_t size = source_.list_size(*corners.count_type, source_.item_bytes(corners.type));
    if (size == 0) source_.fail("a face without vertices");
    polygon_.clear();
    for (std::uint64_t i = 0; i < size; ++i) polygon_.push_back(read_vertex_id(corners.type));
    if (size > 3) note_polygon();
    add_polygon(frame_.mesh, polygon_);
  }

  void note_polygon() {
    if (polygons_ == nullptr) return;
    if (polygons_->rule == PolygonRule::refuse) source_.fail(refused_polygon(polygon_.size()));
    polygons_->fans.push_back({frame_.mesh.faces.size(), polygon_.size() - 2});
  }

  void read_edges(const PlyElement& element) {
    const PlyProperty* first = &require_scalar(file_, element, "vertex1");
    const PlyProperty* second = &require_scalar(file_, element, "vertex2");
    require_integer(file_, element, *first);
    require_integer(file_, element, *second);
    frame_.mesh.edges.reserve(element.count);
    std::array<VertexId, 2> edge{};
    const auto read_property = [&](const PlyProperty& property) {
      if (&property == first || &property == second) {
        edge[&property == first ? 0 : 1] = read_vertex_id(property.type);
      } else {
        skip(property);
      }
    };
    read_entries(element, read_property, [&] { frame_.mesh.edges.push_back(edge); });
  }

  VertexId read_vertex_id(PlyType type) {
    const std::int64_t index = source_.integer(type);
    if (index < 0 || static_cast<std::uint64_t>(index) >= frame_.mesh.vertex_count) {
      source_.fail(fmt::format("vertex index {} is out of range, the file has {} vertices, counted from 0", index,
                               frame_.mesh.vertex_count));
    }
    return static_cast<VertexId>(index);
  }

  Source source_;
  const PlyHeader& header_;
  const std::string& file_;
  Polygons* polygons_;
  Frame frame_;
  std::vector<VertexId> polygon_;  ///< corners of the face that is being read
};

}  // namespace

Frame parse_ply(std::string_view bytes, const std::string& file, Polygons* polygons) {
  if (bytes.empty()) throw InputError(file, "", "is empty");
  const PlyHeader header = parse_ply_header(bytes, file);
  switch (header.format) {
    case PlyFormat::binary_little_endian:
      return BodyReader<BinarySource<std::endian::little>>(bytes, header, file, polygons).read();
    case PlyFormat::binary_big_endian:
      return BodyReader<BinarySource<std::endian::big>>(bytes, header, file, polygons).read();
    case PlyFormat::ascii: break;
  }
  return BodyReader<AsciiSource>(bytes, header, file, polygons).read();
}

}  // namespace noli
