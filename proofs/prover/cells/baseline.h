// SPDX-License-Identifier: Apache-2.0
//
// Pairs of cells that meet before the motion begins, and are not compared later: `noli verify --only-new`.
//
// Notation
//   feature   a vertex, an edge or a face, as the set of its vertices; a cell has all features on its vertices
//
// A pair of features counts as long as one pair of cells that have them is compared. An edge at which a cell of the
// baseline borders on another cell is therefore still compared for the other cell.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <noli/findings.h>
#include <noli/mesh.h>

namespace noli {

class Baseline {
 public:
  using CellPair = InitialIntersection;

  /// `pairs`: of cells of the mesh, ascending, each once. Time and memory: linear in the mesh.
  Baseline(const Mesh& mesh, std::vector<CellPair> pairs);

  const std::vector<CellPair>& pairs() const { return pairs_; }

  /// Whether a pair of cells is in it.
  bool has(std::uint32_t a, std::uint32_t b) const;

  /// Whether all pairs of different cells that have these two features are in it; with `strict`, also no cell has both.
  /// Precondition: the features have no vertex in common, and some pair of cells that is compared without a baseline
  /// has them.
  bool covers(std::span<const VertexId> first, std::span<const VertexId> second, bool strict) const;

 private:
  /// The cells that have all these vertices, ascending; none if one of the vertices is of no cell of the baseline.
  std::vector<std::uint32_t> cells_with(std::span<const VertexId> feature) const;

  std::vector<CellPair> pairs_;
  std::unordered_map<VertexId, std::vector<std::uint32_t>> cells_at_;  ///< by vertex of the baseline's cells, ascending
};

}  // namespace noli
