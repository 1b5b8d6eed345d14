// SPDX-License-Identifier: Apache-2.0
//
// Frames of VTKHDF: polygonal data and unstructured grids, at rest or in steps, in any number of parts.
// Format: docs.vtk.org, "VTKHDF format specification", versions 1 and 2.
//
// Notation
//   part    a piece of the mesh, with points and cells of its own. Arrays have the parts of all steps one after another
//   begin   where the data of a step begin in an array: Steps/PointOffsets, CellOffsets, ConnectivityIdOffsets
//   ends    the dataset Offsets: for each part a 0, then where each of its cells ends
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <noli/mesh.h>
#include "certify/series/hdf5_input.h"
#include "trajectory/formats/polygons.h"

namespace noli::series {

/// Rows of an array.
struct Rows {
  std::uint64_t first = 0, count = 0;
};

class VtkHdf {
 public:
  /// Throws BadInput for other kinds of data, and for versions that are not known.
  explicit VtkHdf(const Hdf5Input& file);

  std::uint64_t steps() const { return steps_; }
  const Hdf5Array& points() const { return points_; }
  /// The points of a step.
  Rows points_of(std::uint64_t step) const;
  /// The cells of a step. Throws BadInput, also for polygons that are refused.
  Mesh mesh_of(std::uint64_t step, Polygons& polygons) const;
  /// What decides the cells of a step: steps with equal keys have the same.
  std::vector<std::uint64_t> cells_key(std::uint64_t step) const;

 private:
  /// The cells of one kind, or all cells of an unstructured grid.
  struct Topology {
    std::string group;                         ///< "VTKHDF/Polygons"
    std::size_t column = 0;                    ///< in CellOffsets and ConnectivityIdOffsets
    std::optional<std::int64_t> type;          ///< of all cells; nothing: dataset Types has them
    std::vector<std::int64_t> cells, corners;  ///< numbers of them, by part
  };
  /// Where the data of a part of one topology are.
  struct Place {
    Rows cells, ends, corners;
  };

  void require_all_used() const;
  void add_topology(const std::string& group, std::size_t column, std::optional<std::int64_t> type);
  Rows parts_of(std::uint64_t step) const;
  std::uint64_t begin(const char* name, std::uint64_t step, std::size_t column) const;
  std::vector<Place> places(const Topology& topology, std::uint64_t step) const;
  std::uint64_t ends_before(const Topology& topology, std::uint64_t first_part, std::uint64_t first_cell) const;

  const Hdf5Input& file_;
  Hdf5Array points_;
  std::uint64_t steps_ = 1;
  bool in_steps_ = false;
  bool parts_are_told_ = false;  ///< by NumberOfParts
  /// Of the arrays in Steps that were asked for, by name: all numbers, row by row.
  struct ByStep {
    std::uint64_t columns;
    std::vector<std::int64_t> numbers;
  };
  mutable std::map<std::string, ByStep> by_step_;
  std::vector<std::int64_t> points_by_part_;
  std::vector<Topology> topologies_;
};

}  // namespace noli::series
