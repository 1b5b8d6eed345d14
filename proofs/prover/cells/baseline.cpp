// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/cells/baseline.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "trajectory/cell_features.h"

namespace noli {
namespace {

std::pair<std::uint32_t, std::uint32_t> key_of(const InitialIntersection& pair) {
  return {pair.first_cell, pair.second_cell};
}

}  // namespace

Baseline::Baseline(const Mesh& mesh, std::vector<CellPair> pairs) : pairs_(std::move(pairs)) {
  for (const auto& [a, b] : pairs_) {
    for (const VertexId v : corners(mesh, a)) cells_at_[v];
    for (const VertexId v : corners(mesh, b)) cells_at_[v];
  }
  if (cells_at_.empty()) return;
  for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
    for (const VertexId v : corners(mesh, cell)) {
      const auto at = cells_at_.find(v);
      if (at != cells_at_.end() && (at->second.empty() || at->second.back() != cell)) at->second.push_back(cell);
    }
  }
}

bool Baseline::has(std::uint32_t a, std::uint32_t b) const {
  const CellPair pair = {std::min(a, b), std::max(a, b)};
  return std::binary_search(pairs_.begin(), pairs_.end(), pair,
                            [](const CellPair& p, const CellPair& q) { return key_of(p) < key_of(q); });
}

bool Baseline::covers(std::span<const VertexId> first, std::span<const VertexId> second, bool strict) const {
  const std::vector<std::uint32_t> of_first = cells_with(first), of_second = cells_with(second);
  if (of_first.empty() || of_second.empty()) return false;
  return std::ranges::all_of(of_first, [&](std::uint32_t a) {
    return std::ranges::all_of(of_second, [&](std::uint32_t b) { return a == b ? !strict : has(a, b); });
  });
}

std::vector<std::uint32_t> Baseline::cells_with(std::span<const VertexId> feature) const {
  std::vector<std::uint32_t> cells;
  for (std::size_t i = 0; i < feature.size(); ++i) {
    const auto at = cells_at_.find(feature[i]);
    if (at == cells_at_.end()) return {};
    if (i == 0) {
      cells = at->second;
      continue;
    }
    std::vector<std::uint32_t> both;
    std::ranges::set_intersection(cells, at->second, std::back_inserter(both));
    cells = std::move(both);
  }
  return cells;
}

}  // namespace noli
