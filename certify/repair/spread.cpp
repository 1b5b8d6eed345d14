// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/spread.h"

#include <algorithm>
#include <array>
#include <utility>

namespace noli {
namespace {

/// Of a displacement, in each step: it goes back where there is room.
constexpr double kept = 0.9;
/// A displacement below this share of the largest one counts as 0, so that vertices far away end exactly where they
/// were given.
constexpr double least_share = 0x1p-10;

double square_of(const Position& d) { return d[0] * d[0] + d[1] * d[1] + d[2] * d[2]; }

double largest_square(const std::vector<Position>& d) {
  double largest = 0;
  for (const Position& of : d) largest = std::max(largest, square_of(of));
  return largest;
}

}  // namespace

SpreadDisplacement::SpreadDisplacement(const Mesh& mesh, std::span<const std::uint8_t> fixed, std::uint64_t spread)
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

void SpreadDisplacement::spread_once(const std::vector<Position>& d, std::vector<Position>& next) const {
  for (std::size_t v = 0; v < d.size(); ++v) {
    const std::size_t count = first_[v + 1] - first_[v];
    if (fixed_[v] != 0 || count == 0) continue;
    Position sum{};
    for (std::size_t i = first_[v]; i < first_[v + 1]; ++i) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += d[neighbours_[i]][k];
    }
    for (std::size_t k = 0; k < 3; ++k) next[v][k] = 0.5 * (d[v][k] + sum[k] / static_cast<double>(count));
  }
}

std::vector<Position> SpreadDisplacement::operator()(std::span<const Position> x, std::span<const Position> y,
                                                     const std::function<bool()>& stop) const {
  std::vector<Position> d(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) d[v][k] = kept * (x[v][k] - y[v][k]);
  }
  if (!(largest_square(d) > 0)) return d;
  std::vector<Position> next = d;
  for (std::uint64_t round = 0; round < rounds_ && !stop(); ++round) {
    spread_once(d, next);
    std::swap(d, next);
  }
  const double least = least_share * least_share * largest_square(d);
  for (Position& of : d) {
    if (square_of(of) < least) of = {};
  }
  return d;
}

}  // namespace noli
