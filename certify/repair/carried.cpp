// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/carried.h"

#include <algorithm>
#include <array>

namespace noli {

CarriedDisplacement::CarriedDisplacement(const Mesh& mesh, std::span<const std::uint8_t> fixed, std::uint64_t spread)
    : rounds_(spread * spread), fixed_(fixed), first_(mesh.vertex_count + 1, 0) {
  std::vector<std::array<VertexId, 2>> pairs;
  const auto add = [&pairs](VertexId a, VertexId b) {
    pairs.push_back({a, b});
    pairs.push_back({b, a});
  };
  for (const auto& [a, b, c] : mesh.faces) add(a, b), add(b, c), add(c, a);
  for (const auto& [a, b] : mesh.edges) add(a, b);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [a, b] : pairs) {
    ++first_[a + 1];
    neighbours_.push_back(b);
  }
  for (std::size_t v = 0; v < mesh.vertex_count; ++v) first_[v + 1] += first_[v];
}

std::vector<Position> CarriedDisplacement::operator()(std::span<const Position> x, std::span<const Position> y) const {
  std::vector<Position> d(x.size()), next;
  for (std::size_t v = 0; v < x.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) d[v][k] = kept * (x[v][k] - y[v][k]);
  }
  next = d;
  for (std::uint64_t round = 0; round < rounds_; ++round) {
    for (std::size_t v = 0; v < d.size(); ++v) {
      const std::size_t count = first_[v + 1] - first_[v];
      if (fixed_[v] != 0 || count == 0) continue;
      Position sum{};
      for (std::size_t i = first_[v]; i < first_[v + 1]; ++i) {
        for (std::size_t k = 0; k < 3; ++k) sum[k] += d[neighbours_[i]][k];
      }
      for (std::size_t k = 0; k < 3; ++k) next[v][k] = 0.5 * (d[v][k] + sum[k] / static_cast<double>(count));
    }
    std::swap(d, next);
  }
  return d;
}

}  // namespace noli
