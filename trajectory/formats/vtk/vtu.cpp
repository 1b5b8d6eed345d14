// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/vtk/vtu.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <noli/errors.h>
#include "trajectory/cells.h"
#include "trajectory/formats/vtk/vtk_cell_reader.h"
#include "trajectory/formats/vtk/vtk_xml.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

constexpr std::array<std::string_view, 2> mesh_types = {"UnstructuredGrid", "PolyData"};

class VtkMesh {
 public:
  VtkMesh(std::string_view bytes, const std::string& file, Polygons* polygons)
      : xml_(bytes, file, mesh_types), cells_(frame_.mesh, polygons) {}

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
    cells_.begin_piece(frame_.positions.size());
    read_points(piece);
    if (std::string_view(xml_.content().name()) == "UnstructuredGrid") {
      const pugi::xml_node cells = xml_.only(piece, "Cells");
      const auto types = xml_.integers(named(cells, "types"));
      require_count(cells, types.size(), piece, "NumberOfCells");
      read_cells(cells, types, types.size());
      return;
    }
    for (const VtkKind& kind : vtk_kinds) {
      const pugi::xml_node cells = xml_.only(piece, kind.xml);
      if (!cells || !cells.child("DataArray")) {
        require_count(cells ? cells : piece, 0, piece, kind.count);
        continue;
      }
      const std::size_t there = read_cells(cells, std::array{std::int64_t{kind.type}}, std::nullopt);
      require_count(cells, there, piece, kind.count);
    }
  }

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
      if (one.attribute("TimeStep")) xml_.fail(one, "is for one of several times; expected one frame per file");
      array = one;
    }
    if (!array) throw InputError(xml_.file(), parent.name(), fmt::format("has no DataArray {}", in_quotes(name)));
    return array;
  }

  void read_points(const pugi::xml_node& piece) {
    const pugi::xml_node array = xml_.only(xml_.only(piece, "Points"), "DataArray");
    if (!array) throw InputError(xml_.file(), "Points", "has no DataArray");
    if (array.attribute("TimeStep")) xml_.fail(array, "is for one of several times; expected one frame per file");
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
  std::size_t read_cells(const pugi::xml_node& cells, std::span<const std::int64_t> types,
                         std::optional<std::size_t> count) {
    const pugi::xml_node ends = named(cells, "offsets");
    const std::vector<std::int64_t> offsets = xml_.integers(ends);
    const std::vector<std::int64_t> corners = xml_.integers(named(cells, "connectivity"));
    if (count && offsets.size() != *count)
      xml_.fail(ends, fmt::format("has {} numbers for {} cells", offsets.size(), *count));
    cells_.add(types, corners, offsets,
               [&](const std::string& message) { throw InputError(xml_.file(), cells.name(), message); });
    return offsets.size();
  }

  VtkXml xml_;
  Frame frame_;
  VtkCellReader cells_;
};

}  // namespace

Frame parse_vtk(std::string_view bytes, const std::string& file, Polygons* polygons, VtkNumbers* numbers) {
  VtkMesh mesh(bytes, file, polygons);
  Frame frame = mesh.read();
  if (numbers != nullptr) *numbers = mesh.numbers();
  return frame;
}

}  // namespace noli
