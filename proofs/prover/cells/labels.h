// SPDX-License-Identifier: Apache-2.0
//
// Labels of cells, which decide which pairs of cells are not compared (proofs/FORMAT.md, "Labels").
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include <noli/mesh.h>

namespace noli {

/// Unordered pairs of labels, the smaller first.
using LabelPairs = std::set<std::array<std::uint32_t, 2>>;

struct CellLabels {
  std::vector<std::uint32_t> of;  ///< one for each cell
  LabelPairs excluded;            ///< pairs that occur and are not compared

  /// Whether cells with these labels are not compared.
  bool excludes(std::uint32_t a, std::uint32_t b) const {
    return !excluded.empty() && excluded.contains({std::min(a, b), std::max(a, b)});
  }
  /// Whether two cells, or a cell and itself, are not compared.
  bool leave_out(std::uint32_t i, std::uint32_t j) const { return excludes(of[i], of[j]); }
};

/// The labels of a run: 2 g + s for each cell, with g its group and s = 1 if all its vertices are scripted. Cells are
/// not compared if both are scripted, or if their groups are excluded. `scripted`: as in WindowOptions.
CellLabels labels_of_run(const Mesh& mesh, std::span<const std::uint8_t> scripted, const Exclusions& exclusions);

}  // namespace noli
