// SPDX-License-Identifier: Apache-2.0
//
// The features of two cells, as sets of their vertices.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include <noli/query.h>
#include "proofs/prover/tokens/mesh_paths.h"
#include "trajectory/cell_features.h"

namespace noli {

/// The vertices of two features.
struct FeatureSides {
  std::vector<VertexId> p, q;

  std::vector<VertexId> both() const {
    std::vector<VertexId> all = p;
    all.insert(all.end(), q.begin(), q.end());
    return all;
  }
};

/// The vertices of a cell, each once, ascending.
inline std::vector<VertexId> vertices_of(const Mesh& mesh, std::uint32_t cell) {
  const auto v = corners(mesh, cell);
  std::vector<VertexId> result(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(corner_count(mesh, cell)));
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// The vertices at the set bits of the mask.
inline std::vector<VertexId> chosen(std::span<const VertexId> all, unsigned mask) {
  std::vector<VertexId> result;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if ((mask >> k & 1) != 0) result.push_back(all[k]);
  }
  return result;
}

/// The kind of the pair; nothing for other pairs, such as those in which p has more vertices than q.
inline std::optional<FeaturePair> pair_of(const FeatureSides& s) {
  for (const FeaturePair pair : all_feature_pairs) {
    if (s.p.size() == first_size(pair) && s.q.size() == second_size(pair)) return pair;
  }
  return std::nullopt;
}

/// Whether a path joins a vertex of one to one of the other.
inline bool joined(const FeatureSides& s, const MeshPaths& paths) {
  return std::ranges::any_of(s.p, [&](VertexId v) {
    return std::ranges::any_of(s.q, [&](VertexId w) { return paths.find(v, w).has_value(); });
  });
}

}  // namespace noli
