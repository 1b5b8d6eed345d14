// SPDX-License-Identifier: Apache-2.0
#include "certificates/features.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "trajectory/cell_features.h"

namespace noli::certificates {

Features::Features(const Mesh& mesh, int dimension) : dimension_(dimension) {
  constexpr std::size_t most = std::size_t{1} << 31;
  if (mesh.vertex_count >= most || 3 * mesh.faces.size() + mesh.edges.size() >= most) {
    throw std::invalid_argument("features: expected fewer than 2^31 vertices and edges");
  }
  add_cells(mesh);
  number_edges(mesh.vertex_count);
  list_cells(mesh.vertex_count);
}

void Features::add_cells(const Mesh& mesh) {
  const CellFeatures features = find_owners(mesh, false);
  cells_.reserve(mesh.cell_count());
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    const FeatureMask owned = features.owned[c];
    cells_.push_back({corners(mesh, c),
                      static_cast<std::uint8_t>(corner_count(mesh, c)),
                      static_cast<std::uint8_t>(owned & 7),
                      static_cast<std::uint8_t>(owned >> 3 & 7),
                      {}});
  }
}

void Features::number_edges(std::size_t vertex_count) {
  const auto edge_of = [](const Cell& cell, std::size_t k) {
    const auto [least, greatest] = std::minmax(cell.vertices[k], cell.vertices[(k + 1) % cell.size]);
    return std::array<VertexId, 2>{least, greatest};
  };
  std::vector<std::size_t> begin(vertex_count + 1, 0);  // of the edges of each least vertex, after partial_sum
  for (const Cell& cell : cells_) {
    for (std::size_t k = 0; k < cell.edge_count(); ++k) {
      if ((cell.owned_edges >> k & 1) == 0) continue;
      edges_.push_back(edge_of(cell, k));
      ++begin[edges_.back()[0] + 1];
    }
  }
  std::sort(edges_.begin(), edges_.end());
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (Cell& cell : cells_) {
    for (std::size_t k = 0; k < cell.edge_count(); ++k) {
      const std::array<VertexId, 2> edge = edge_of(cell, k);
      const auto* const first = edges_.data() + begin[edge[0]];
      const auto* const last = edges_.data() + begin[edge[0] + 1];
      cell.edges[k] = static_cast<std::uint32_t>(std::lower_bound(first, last, edge) - edges_.data());
    }
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
