// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/mesh_paths.h"

#include <algorithm>
#include <map>

#include "trajectory/cell_features.h"

namespace noli {

MeshPaths::MeshPaths(const Mesh& mesh, std::uint32_t ring) : mesh_(mesh), ring_(ring) {
  if (ring < 2) return;
  std::vector<std::vector<std::uint32_t>> lists(mesh.vertex_count);
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    for (const VertexId v : corners(mesh, c)) {
      if (lists[v].empty() || lists[v].back() != c) lists[v].push_back(c);
    }
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
        for (const VertexId end : corners(mesh_, cells_[i])) {
          if (from.insert({end, {cells_[i], u}}).second) next.push_back(end);
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
