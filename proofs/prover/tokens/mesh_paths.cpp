// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/mesh_paths.h"

#include <algorithm>
#include <map>

namespace noli {

MeshPaths::MeshPaths(const ProofTree& tree, std::size_t vertices, std::uint32_t ring) : tree_(tree), ring_(ring) {
  if (ring < 2) return;
  std::vector<std::vector<std::uint32_t>> lists(vertices);
  for (const ProofTree::Node& node : tree.nodes()) {
    if (!node.leaf()) continue;
    const ProofCell& cell = tree.cell(node.cell);
    for (std::size_t i = 0; i < cell.corners; ++i) lists[cell.vertices[i]].push_back(node.cell);
  }
  begin_.push_back(0);
  for (const auto& list : lists) {
    cells_.insert(cells_.end(), list.begin(), list.end());
    begin_.push_back(static_cast<std::uint32_t>(cells_.size()));
  }
}

std::optional<MeshPaths::Steps> MeshPaths::find(VertexId v, VertexId w) const {
  if (v == w) return Steps{};
  std::map<VertexId, std::array<std::uint32_t, 2>> from;  // the cell and the vertex by which a vertex was reached
  std::vector<VertexId> frontier = {v};
  from[v] = {0, v};
  for (std::uint32_t length = 1; length < ring_ && from.count(w) == 0; ++length) {
    std::vector<VertexId> next;
    for (const VertexId u : frontier) {
      for (std::uint32_t i = begin_[u]; i < begin_[u + 1]; ++i) {
        const ProofCell& cell = tree_.cell(cells_[i]);
        for (std::size_t k = 0; k < cell.corners; ++k) {
          if (from.insert({cell.vertices[k], {cells_[i], u}}).second) next.push_back(cell.vertices[k]);
        }
      }
    }
    frontier = std::move(next);
  }
  if (from.count(w) == 0) return std::nullopt;
  Steps steps;
  for (VertexId u = w; u != v; u = from[u][1]) steps.push_back({from[u][0], u});
  std::reverse(steps.begin(), steps.end());
  return steps;
}

}  // namespace noli
