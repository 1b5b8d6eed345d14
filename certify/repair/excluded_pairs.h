// SPDX-License-Identifier: Apache-2.0
//
// The pairs of features that may pass through each other because cells intersect in the first frame (--only-new), as
// the certificates of contact number them.
#pragma once

#include <algorithm>
#include <set>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "certificates/features.h"
#include "proofs/prover/cells/baseline.h"

namespace noli {

/// Keys, ascending. O(pairs of the baseline), for a mesh whose vertices have few cells each.
inline std::vector<certificates::PairKey> excluded_pairs(const certificates::Features& features,
                                                         const Baseline& baseline) {
  const auto around = [&](std::uint32_t cell) {  // all cells that may own a feature of this one
    std::vector<std::uint32_t> cells;
    for (const VertexId v : features.cells()[cell].all()) {
      cells.insert(cells.end(), features.cells_of(v).begin(), features.cells_of(v).end());
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  };
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  std::vector<certificates::PairKey> keys;
  for (const auto& [first, second] : baseline.pairs()) {
    for (const std::uint32_t a : around(first)) {
      for (const std::uint32_t b : around(second)) {
        if (a == b || !seen.insert(std::minmax(a, b)).second) continue;
        features.for_each_pair(a, b, [&](const certificates::Stencil& pair) {
          const std::span<const VertexId> all(pair.vertices.data(), pair.size());
          if (baseline.covers(all.first(pair.first()), all.subspan(pair.first()), false)) keys.push_back(pair.key);
        });
      }
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

}  // namespace noli
