// SPDX-License-Identifier: Apache-2.0
#include "certify/series/vtkhdf.h"

#include <utility>

#include "trajectory/cells.h"
#include "trajectory/formats/vtk/vtk_cell_reader.h"

namespace noli::series {
namespace {

const std::string root = "VTKHDF", steps_group = root + "/Steps";
constexpr std::uint64_t most_steps = std::uint64_t{1} << 32;

/// A count of a file.
std::uint64_t count_of(std::int64_t number, const std::string& where) {
  if (number < 0) throw BadInput(where, std::to_string(number) + " is not a count");
  return static_cast<std::uint64_t>(number);
}

std::uint64_t sum(std::uint64_t a, std::uint64_t b, const std::string& where) {
  std::uint64_t result = 0;
  if (__builtin_add_overflow(a, b, &result)) throw BadInput(where, "its counts are too large");
  return result;
}

/// All numbers of an array of one for each part.
std::vector<std::int64_t> by_part(const Hdf5Input& file, const std::string& name) {
  const Hdf5Array array = file.array(name);
  if (array.row() != 1) throw BadInput(name, "expected one number for each part");
  return array.integers(0, array.shape()[0]);
}

}  // namespace

VtkHdf::VtkHdf(const Hdf5Input& file) : file_(file), points_(file.array(root + "/Points")) {
  const std::int64_t version = file.integers(root, "Version")[0];
  if (version < 1 || version > 2) {
    throw BadInput(root, "has version " + std::to_string(version) + "; expected 1 or 2");
  }
  if (points_.type() == Hdf5Array::Type::integer || points_.shape().size() != 2 || points_.row() != 3) {
    throw BadInput(points_.name(), "expected real numbers of shape (points, 3)");
  }
  points_by_part_ = by_part(file, root + "/NumberOfPoints");
  const std::string type = file.text(root, "Type");
  if (type == "UnstructuredGrid") {
    add_topology(root, 0, std::nullopt);
  } else if (type == "PolyData") {
    for (const VtkKind& kind : vtk_kinds) {
      const std::string group = root + "/" + kind.hdf;
      if (file.has(group)) add_topology(group, kind.column, kind.type);
    }
  } else {
    throw BadInput(root, "is of type " + type + "; expected PolyData or UnstructuredGrid");
  }
  in_steps_ = file.has(steps_group);
  parts_are_told_ = in_steps_ && file.has(steps_group + "/NumberOfParts");
  if (in_steps_) steps_ = count_of(file.integers(steps_group, "NSteps")[0], steps_group + ".NSteps");
  if (steps_ > most_steps) throw BadInput(steps_group, "has too many steps");
  if (!in_steps_) require_all_used();
}

/// Without steps, an array with more numbers than the parts have says that something was misunderstood.
void VtkHdf::require_all_used() const {
  const auto require_rows = [](const Hdf5Array& array, std::uint64_t rows) {
    if (array.shape()[0] == rows) return;
    throw BadInput(array.name(),
                   "has " + std::to_string(array.shape()[0]) + " rows, but its parts have " + std::to_string(rows));
  };
  require_rows(points_, points_of(0).count);
  for (const Topology& topology : topologies_) {
    std::uint64_t cells = 0, ends = 0, corners = 0;
    for (const Place& place : places(topology, 0)) {
      cells += place.cells.count;
      ends += place.cells.count + 1;
      corners += place.corners.count;
    }
    if (!topology.type) require_rows(file_.array(root + "/Types"), cells);
    require_rows(file_.array(topology.group + "/Connectivity"), corners);
    if (cells > 0) require_rows(file_.array(topology.group + "/Offsets"), ends);
  }
}

void VtkHdf::add_topology(const std::string& group, std::size_t column, std::optional<std::int64_t> type) {
  Topology topology{group, column, type, by_part(file_, group + "/NumberOfCells"),
                    by_part(file_, group + "/NumberOfConnectivityIds")};
  if (topology.cells.size() != points_by_part_.size() || topology.corners.size() != points_by_part_.size()) {
    throw BadInput(group, "has counts for a different number of parts from " + root + "/NumberOfPoints");
  }
  topologies_.push_back(std::move(topology));
}

/// The parts of a step. Without NumberOfParts, one part is that of all steps, or each step has one.
Rows VtkHdf::parts_of(std::uint64_t step) const {
  const std::uint64_t all = points_by_part_.size();
  if (!in_steps_) return {0, all};
  const std::uint64_t first = begin("PartOffsets", step, 0);
  std::uint64_t count = 1;
  if (parts_are_told_) {
    count = begin("NumberOfParts", step, 0);
  } else if (all != 1 && !(all == steps_ && first == step)) {
    throw BadInput(steps_group + "/NumberOfParts", "is not there, and there are several parts");
  }
  if (first > all || count > all - first) {
    throw BadInput(steps_group, "step " + std::to_string(step) + " has parts that are not there");
  }
  return {first, count};
}

std::uint64_t VtkHdf::begin(const char* name, std::uint64_t step, std::size_t column) const {
  if (!in_steps_) return 0;
  const std::string path = steps_group + "/" + name;
  auto known = by_step_.find(name);
  if (known == by_step_.end()) {
    const Hdf5Array array = file_.array(path);
    if (array.row() > 16) throw BadInput(path, "expected another number of columns");
    known = by_step_.emplace(name, ByStep{array.row(), array.integers(0, array.shape()[0])}).first;
  }
  const auto& [columns, numbers] = known->second;
  if (columns <= column) throw BadInput(path, "expected another number of columns");
  if (step >= numbers.size() / columns) throw BadInput(path, "has no row for step " + std::to_string(step));
  return count_of(numbers[static_cast<std::size_t>(step * columns + column)], path);
}

Rows VtkHdf::points_of(std::uint64_t step) const {
  const Rows parts = parts_of(step);
  Rows rows{begin("PointOffsets", step, 0), 0};
  for (std::uint64_t p = 0; p < parts.count; ++p) {
    rows.count = sum(rows.count, count_of(points_by_part_[parts.first + p], root + "/NumberOfPoints"), points_.name());
  }
  points_.require_rows(rows.first, rows.count);
  return rows;
}

/// How many numbers `ends` has before those of a step, besides one for each cell. VTK's own reader counts the parts
/// before the step in an unstructured grid; for polygonal data, those whose cells come before.
std::uint64_t VtkHdf::ends_before(const Topology& topology, std::uint64_t first_part, std::uint64_t first_cell) const {
  if (!topology.type) return first_part;
  std::uint64_t parts = 0, cells = 0;
  for (; parts < first_part && cells < first_cell; ++parts) {
    cells = sum(cells, count_of(topology.cells[parts], topology.group), topology.group);
  }
  return parts;
}

std::vector<VtkHdf::Place> VtkHdf::places(const Topology& topology, std::uint64_t step) const {
  const Rows parts = parts_of(step);
  std::uint64_t cell = begin("CellOffsets", step, topology.column);
  std::uint64_t corner = begin("ConnectivityIdOffsets", step, topology.column);
  std::uint64_t end = sum(cell, ends_before(topology, parts.first, cell), topology.group);
  std::vector<Place> places;
  for (std::uint64_t p = parts.first; p < parts.first + parts.count; ++p) {
    const std::uint64_t cells = count_of(topology.cells[p], topology.group + "/NumberOfCells");
    const std::uint64_t corners = count_of(topology.corners[p], topology.group + "/NumberOfConnectivityIds");
    places.push_back({{cell, cells}, {end, cells == 0 ? 0 : sum(cells, 1, topology.group)}, {corner, corners}});
    cell = sum(cell, cells, topology.group);
    corner = sum(corner, corners, topology.group);
    end = sum(end, sum(cells, 1, topology.group), topology.group);
  }
  return places;
}

std::vector<std::uint64_t> VtkHdf::cells_key(std::uint64_t step) const {
  const Rows parts = parts_of(step);
  std::vector<std::uint64_t> key;
  for (std::uint64_t p = 0; p < parts.count; ++p) {
    key.push_back(count_of(points_by_part_[parts.first + p], root + "/NumberOfPoints"));
  }
  for (const Topology& topology : topologies_) {
    for (const Place& place : places(topology, step)) {
      for (const Rows& rows : {place.cells, place.ends, place.corners}) key.insert(key.end(), {rows.first, rows.count});
    }
  }
  return key;
}

Mesh VtkHdf::mesh_of(std::uint64_t step, Polygons& polygons) const {
  Mesh mesh;
  VtkCellReader reader(mesh, &polygons);
  const Rows parts = parts_of(step);
  std::vector<std::vector<Place>> all;
  for (const Topology& topology : topologies_) all.push_back(places(topology, step));
  for (std::uint64_t p = 0; p < parts.count; ++p) {
    reader.begin_piece(mesh.vertex_count);
    mesh.vertex_count += count_of(points_by_part_[parts.first + p], root + "/NumberOfPoints");
    if (mesh.vertex_count > 0xffffffff) throw BadInput(points_.name(), "has more than 4294967295 points in a step");
    for (std::size_t i = 0; i < topologies_.size(); ++i) {
      const Topology& topology = topologies_[i];
      const Place& place = all[i][p];
      const auto corners =
          file_.array(topology.group + "/Connectivity").integers(place.corners.first, place.corners.count);
      const auto ends = file_.array(topology.group + "/Offsets").integers(place.ends.first, place.ends.count);
      const auto fail = [&](const std::string& message) { throw BadInput(topology.group, message); };
      if (!ends.empty() && ends[0] != 0) fail("Offsets of a part begin with " + std::to_string(ends[0]) + ", not 0");
      const auto types = topology.type ? std::vector<std::int64_t>{*topology.type}
                                       : file_.array(root + "/Types").integers(place.cells.first, place.cells.count);
      reader.add(types, corners, std::span(ends).subspan(ends.empty() ? 0 : 1), fail);
    }
  }
  drop_redundant_cells(mesh);
  return mesh;
}

}  // namespace noli::series
