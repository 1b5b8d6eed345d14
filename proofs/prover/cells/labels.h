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

  /// Whether two cells, or a cell and itself, are not compared.
  bool leave_out(std::uint32_t i, std::uint32_t j) const {
    return !excluded.empty() && excluded.contains({std::min(of[i], of[j]), std::max(of[i], of[j])});
  }
};

/// Whether cells with these labels of a run are not compared: both scripted, or of excluded groups.
inline bool left_out(std::uint32_t a, std::uint32_t b, const Exclusions& exclusions) {
  const auto group = [](std::uint32_t label) { return static_cast<std::uint16_t>(label / 2); };
  return (a % 2 == 1 && b % 2 == 1) || (!exclusions.empty() && exclusions.excluded(group(a), group(b)));
}

/// The labels of a run: 2 g + s for each cell, with g its group and s = 1 if all its vertices are scripted. `scripted`:
/// as in WindowOptions.
std::vector<std::uint32_t> run_labels(const Mesh& mesh, std::span<const std::uint8_t> scripted,
                                      const Exclusions& exclusions);

/// The same, with the pairs that are not compared.
CellLabels labels_of_run(const Mesh& mesh, std::span<const std::uint8_t> scripted, const Exclusions& exclusions);

}  // namespace noli
