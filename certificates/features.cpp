// SPDX-License-Identifier: Apache-2.0
#include "certificates/features.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace noli::certificates {

Features::Features(const Mesh& mesh, int dimension) : dimension_(dimension) {
  constexpr std::size_t most = std::size_t{1} << 31;
  if (mesh.vertex_count >= most || 3 * mesh.faces.size() + mesh.edges.size() >= most) {
    throw std::invalid_argument("features: expected fewer than 2^31 vertices and edges");
  }
  add_cells(mesh);
  find_owners(mesh.vertex_count);
  list_cells(mesh.vertex_count);
}

void Features::add_cells(const Mesh& mesh) {
  for (const auto& face : mesh.faces) cells_.push_back({face, 3, 0, 0, {}});
  for (const auto& edge : mesh.edges) cells_.push_back({{edge[0], edge[1], 0}, 2, 0, 0, {}});
  for (const VertexId point : mesh.points) cells_.push_back({{point, 0, 0}, 1, 0, 0, {}});
}

void Features::find_owners(std::size_t vertex_count) {
  std::vector<bool> owned(vertex_count, false);
  std::vector<std::pair<std::array<VertexId, 2>, std::pair<std::uint32_t, std::uint8_t>>> sides;
  for (std::uint32_t c = 0; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    for (std::uint8_t k = 0; k < cell.size; ++k) {
      const VertexId v = cell.vertices[k], w = cell.vertices[(k + 1U) % cell.size];
      if (!owned[v]) cell.owned_vertices |= static_cast<std::uint8_t>(1U << k);
      owned[v] = true;
      if (cell.size == 3 || (cell.size == 2 && k == 0)) sides.push_back({{std::min(v, w), std::max(v, w)}, {c, k}});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (const auto& [ends, place] : sides) {
    const auto& [c, k] = place;
    const bool fresh = edges_.empty() || edges_.back() != ends;
    if (fresh) edges_.push_back(ends);
    cells_[c].edges[k] = static_cast<std::uint32_t>(edges_.size() - 1);
    if (fresh) cells_[c].owned_edges |= static_cast<std::uint8_t>(1U << k);
  }
}

void Features::list_cells(std::size_t vertex_count) {
  cells_of_.assign(vertex_count + 1, 0);
  for (const Cell& cell : cells_) {
    for (const VertexId v : cell.all()) ++cells_of_[v + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) cells_of_[v + 1] += cells_of_[v];
  cell_list_.resize(cells_of_.back());
  std::vector<std::size_t> next(cells_of_.begin(), cells_of_.end() - 1);
  for (std::uint32_t c = 0; c < cells_.size(); ++c) {
    for (const VertexId v : cells_[c].all()) cell_list_[next[v]++] = c;
  }
}

}  // namespace noli::certificates
