// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/vtk/vtu.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <noli/errors.h>
#include "trajectory/cells.h"
#include "trajectory/formats/vtk/vtk_xml.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

constexpr std::array<std::string_view, 2> mesh_types = {"UnstructuredGrid", "PolyData"};

/// vtkCellType.h
enum VtkCell : std::int64_t {
  vtk_empty = 0,
  vtk_vertex = 1,
  vtk_poly_vertex = 2,
  vtk_line = 3,
  vtk_poly_line = 4,
  vtk_triangle = 5,
  vtk_triangle_strip = 6,
  vtk_polygon = 7,
  vtk_pixel = 8,
  vtk_quad = 9
};

class VtkMesh {
 public:
  VtkMesh(std::string_view bytes, const std::string& file, Polygons* polygons)
      : xml_(bytes, file, mesh_types), polygons_(polygons) {}

  Frame read() {
    if (xml_.content().attribute("TimeValues"))
      xml_.fail(xml_.content(), "has several times; expected one frame a file");
    for (const pugi::xml_node piece : xml_.content().children("Piece")) read_piece(piece);
    drop_redundant_cells(frame_.mesh);
    return std::move(frame_);
  }

  VtkNumbers numbers() const {
    const pugi::xml_node array = xml_.content().child("Piece").child("Points").child("DataArray");
    VtkNumbers numbers{xml_.type_of(array), ""};
    if (xml_.is_text(array)) numbers.text = xml_.text_of(array);
    return numbers;
  }

 private:
  void read_piece(const pugi::xml_node& piece) {
    end_if_stopped();
    first_ = frame_.positions.size();
    read_points(piece);
    if (std::string_view(xml_.content().name()) == "UnstructuredGrid") {
      const pugi::xml_node cells = xml_.only(piece, "Cells");
      const auto types = xml_.integers(named(cells, "types"));
      require_count(cells, types.size(), piece, "NumberOfCells");
      read_cells(
          cells, [&](std::size_t i) { return types[i]; }, types.size());
      return;
    }
    for (const Kind& kind : kinds) {
      const pugi::xml_node cells = xml_.only(piece, kind.name);
      if (!cells || !cells.child("DataArray")) {
        require_count(cells ? cells : piece, 0, piece, kind.count);
        continue;
      }
      const std::size_t there = read_cells(
          cells, [&](std::size_t) { return std::int64_t{kind.type}; }, std::nullopt);
      require_count(cells, there, piece, kind.count);
    }
  }

  /// The cells of polygonal data.
  struct Kind {
    const char *name, *count;
    VtkCell type;
  };
  static constexpr std::array<Kind, 4> kinds = {{{"Verts", "NumberOfVerts", vtk_poly_vertex},
                                                 {"Lines", "NumberOfLines", vtk_poly_line},
                                                 {"Strips", "NumberOfStrips", vtk_triangle_strip},
                                                 {"Polys", "NumberOfPolys", vtk_polygon}}};

  /// A piece says how many cells it has; some writers leave out those of a kind that it has none of.
  void require_count(const pugi::xml_node& where, std::size_t there, const pugi::xml_node& piece,
                     const char* what) const {
    const std::uint64_t count = piece.attribute(what) ? announced(piece, what) : 0;
    if (there != count) xml_.fail(where, fmt::format("has {} cells, but {} is {}", there, what, count));
  }

  pugi::xml_node named(const pugi::xml_node& parent, const char* name) const {
    pugi::xml_node array;
    for (const pugi::xml_node one : parent.children("DataArray")) {
      if (std::string_view(one.attribute("Name").value()) != name) continue;
      if (array) xml_.fail(array, "is there twice");
      if (one.attribute("TimeStep")) xml_.fail(one, "is of one of several times; expected one frame a file");
      array = one;
    }
    if (!array) throw InputError(xml_.file(), parent.name(), fmt::format("has no DataArray {}", in_quotes(name)));
    return array;
  }

  void read_points(const pugi::xml_node& piece) {
    const pugi::xml_node array = xml_.only(xml_.only(piece, "Points"), "DataArray");
    if (!array) throw InputError(xml_.file(), "Points", "has no DataArray");
    if (array.attribute("TimeStep")) xml_.fail(array, "is of one of several times; expected one frame a file");
    const std::vector<double> numbers = xml_.reals(array);
    const auto count = announced(piece, "NumberOfPoints");
    if (numbers.size() % 3 != 0 || numbers.size() / 3 != count) {
      xml_.fail(array, fmt::format("has {} numbers, but there are {} points", numbers.size(), count));
    }
    if (frame_.positions.size() + count > 0xffffffff) xml_.fail(array, "has more than 4294967295 points");
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!std::isfinite(numbers[i + k])) {
          xml_.fail(array, fmt::format("point {}: expected a finite coordinate, found {}", i / 3, numbers[i + k]));
        }
      }
      frame_.positions.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    }
    frame_.mesh.vertex_count = frame_.positions.size();
  }

  std::uint64_t announced(const pugi::xml_node& piece, const char* what) const {
    std::uint64_t count = 0;
    if (parse_number(std::string_view(piece.attribute(what).value()), count) != std::errc{}) {
      throw InputError(xml_.file(), "Piece", fmt::format("has no {}", what));
    }
    return count;
  }

  /// How many cells there are.
  template <class TypeOf>
  std::size_t read_cells(const pugi::xml_node& cells, const TypeOf& type_of, std::optional<std::size_t> count) {
    const pugi::xml_node ends = named(cells, "offsets");
    const std::vector<std::int64_t> offsets = xml_.integers(ends);
    const std::vector<std::int64_t> corners = xml_.integers(named(cells, "connectivity"));
    if (count && offsets.size() != *count)
      xml_.fail(ends, fmt::format("has {} numbers for {} cells", offsets.size(), *count));
    std::int64_t begin = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      if (i % 4096 == 0) end_if_stopped();
      const std::int64_t end = offsets[i];
      if (end < begin || end > static_cast<std::int64_t>(corners.size())) {
        xml_.fail(ends, fmt::format("cell {} ends at {} of {} corners", i, end, corners.size()));
      }
      cell_.clear();
      for (std::int64_t at = begin; at < end; ++at)
        cell_.push_back(vertex(cells, corners[static_cast<std::size_t>(at)]));
      add_cell(cells, i, type_of(i));
      begin = end;
    }
    if (begin != static_cast<std::int64_t>(corners.size())) {
      xml_.fail(ends, fmt::format("the last cell ends at {} of {} corners", begin, corners.size()));
    }
    return offsets.size();
  }

  VertexId vertex(const pugi::xml_node& cells, std::int64_t v) const {
    const auto there = static_cast<std::int64_t>(frame_.positions.size() - first_);
    if (v < 0 || v >= there) {
      throw InputError(xml_.file(), cells.name(), fmt::format("a cell has point {}; expected 0 to {}", v, there - 1));
    }
    return static_cast<VertexId>(first_ + static_cast<std::size_t>(v));
  }

  void add_cell(const pugi::xml_node& cells, std::size_t number, std::int64_t type) {
    const auto require = [&](bool holds) {
      if (holds) return;
      throw InputError(xml_.file(), cells.name(),
                       fmt::format("cell {} of type {} has {} points", number, type, cell_.size()));
    };
    const std::span<const VertexId> c(cell_);
    switch (type) {
      case vtk_empty: return;
      case vtk_vertex: require(c.size() == 1); return add_polygon(frame_.mesh, c);
      case vtk_poly_vertex:
        for (std::size_t i = 0; i < c.size(); ++i) add_polygon(frame_.mesh, c.subspan(i, 1));
        return;
      case vtk_line: require(c.size() == 2); return add_polygon(frame_.mesh, c);
      case vtk_poly_line:
        require(c.size() >= 2);
        for (std::size_t i = 0; i + 1 < c.size(); ++i) add_polygon(frame_.mesh, c.subspan(i, 2));
        return;
      case vtk_triangle: require(c.size() == 3); return add_polygon(frame_.mesh, c);
      case vtk_triangle_strip:
        require(c.size() >= 3);
        for (std::size_t i = 0; i + 2 < c.size(); ++i) {
          const std::size_t odd = i % 2;  // every other one is the other way round
          add_polygon(frame_.mesh, std::array{c[i], c[i + 1 + odd], c[i + 2 - odd]});
        }
        return;
      case vtk_polygon: require(c.size() >= 3); return add_face(cells, number);
      case vtk_quad: require(c.size() == 4); return add_face(cells, number);
      case vtk_pixel:
        require(c.size() == 4);
        std::swap(cell_[2], cell_[3]);
        return add_face(cells, number);
      default:
        throw InputError(xml_.file(), cells.name(),
                         fmt::format("cell {} has type {}; expected points, lines, triangles or polygons (in ParaView: "
                                     "Extract Surface, Triangulate)",
                                     number, type));
    }
  }

  void add_face(const pugi::xml_node& cells, std::size_t number) {
    if (cell_.size() > 3 && polygons_ != nullptr) {
      if (polygons_->rule == PolygonRule::refuse) {
        throw InputError(xml_.file(), cells.name(), fmt::format("cell {}: {}", number, refused_polygon(cell_.size())));
      }
      polygons_->fans.push_back({frame_.mesh.faces.size(), cell_.size() - 2});
    }
    add_polygon(frame_.mesh, cell_);
  }

  VtkXml xml_;
  Polygons* polygons_;
  Frame frame_;
  std::size_t first_ = 0;  ///< vertex of the piece
  std::vector<VertexId> cell_;
};

}  // namespace

Frame parse_vtk(std::string_view bytes, const std::string& file, Polygons* polygons, VtkNumbers* numbers) {
  VtkMesh mesh(bytes, file, polygons);
  Frame frame = mesh.read();
  if (numbers != nullptr) *numbers = mesh.numbers();
  return frame;
}

}  // namespace noli
