// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/ply.h"

#include <fmt/format.h>

#include <limits>

#include "trajectory/cells.h"
#include "trajectory/error.h"
#include "trajectory/formats/ply_header.h"
#include "trajectory/formats/ply_source.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// Errors that concern the declaration of an element point to its line in the header.
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

/// The one list of vertices of element face.
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

/// Reads the body. Every element is read entry by entry, property by property; what is not needed is skipped.
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
    read_entries(element, [this](std::size_t p, const PlyProperty& property) { skip(p, property); });
  }

  /// Calls `read_property(index, property)` for each property of each entry, and `end_of_entry` after each entry.
  template <class ReadProperty>
  void read_entries(const PlyElement& element, ReadProperty&& read_property) {
    read_entries(element, read_property, [] {});
  }
  template <class ReadProperty, class EndOfEntry>
  void read_entries(const PlyElement& element, ReadProperty&& read_property, EndOfEntry&& end_of_entry) {
    for (std::uint64_t entry = 0; entry < element.count; ++entry) {
      end_if_stopped();
      source_.begin_entry(element, entry);
      for (std::size_t p = 0; p < element.properties.size(); ++p) read_property(p, element.properties[p]);
      end_of_entry();
      source_.end_entry();
    }
  }

  void skip(std::size_t, const PlyProperty& property) {
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
    const auto read_property = [&](std::size_t p, const PlyProperty& property) {
      if (&property == x) {
        position[0] = source_.real(property.type);
      } else if (&property == y) {
        position[1] = source_.real(property.type);
      } else if (&property == z) {
        position[2] = source_.real(property.type);
      } else {
        skip(p, property);
      }
    };
    read_entries(element, read_property, [&] { frame_.positions.push_back(position); });
  }

  void read_faces(const PlyElement& element) {
    const PlyProperty* corners = &require_corners(file_, element);
    frame_.mesh.faces.reserve(element.count);
    read_entries(element, [&](std::size_t p, const PlyProperty& property) {
      if (&property == corners) {
        read_polygon(property);
      } else {
        skip(p, property);
      }
    });
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
    const auto read_property = [&](std::size_t p, const PlyProperty& property) {
      if (&property == first || &property == second) {
        edge[&property == first ? 0 : 1] = read_vertex_id(property.type);
      } else {
        skip(p, property);
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
  using ply::BinarySource;
  switch (header.format) {
    case PlyFormat::binary_little_endian:
      return BodyReader<BinarySource<std::endian::little>>(bytes, header, file, polygons).read();
    case PlyFormat::binary_big_endian:
      return BodyReader<BinarySource<std::endian::big>>(bytes, header, file, polygons).read();
    case PlyFormat::ascii: break;
  }
  return BodyReader<ply::AsciiSource>(bytes, header, file, polygons).read();
}

Frame read_ply(const std::filesystem::path& path) { return parse_ply(read_whole_file(path), path.string()); }

}  // namespace noli
