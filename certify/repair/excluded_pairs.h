// SPDX-License-Identifier: Apache-2.0
//
// The pairs of features that may pass through each other because cells intersect in the first frame (--only-new), as
// the certificates of contact number them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "certificates/features.h"
#include "proofs/prover/cells/baseline.h"

namespace noli {

class ExcludedPairs {
 public:
  ExcludedPairs(const certificates::Features& features, const Baseline& baseline)
      : features_(features), baseline_(baseline) {}

  /// Keys, ascending: some are of no pair that contact knows. O(pairs of the baseline). Not all once `stop` has
  /// returned true.
  std::vector<certificates::PairKey> operator()(const std::function<bool()>& stop) {
    for (const auto& [a, b] : baseline_.pairs()) {
      if (stop()) break;
      // A pair that all cells leave out is left out by these two.
      vertices_and_features(a, b);
      vertices_and_features(b, a);
      edges_and_edges(features_.cells()[a], features_.cells()[b]);
    }
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    return std::move(keys_);
  }

 private:
  using Cell = certificates::Features::Cell;
  using Vertices = std::span<const VertexId>;

  static bool meet(Vertices first, Vertices second) { return std::ranges::find_first_of(first, second) != first.end(); }

  void add(FeaturePair kind, Vertices first, Vertices second, std::uint32_t p, std::uint32_t q) {
    if (meet(first, second) || !baseline_.covers(first, second, false)) return;
    keys_.push_back(certificates::pair_key(kind, p, q));
  }

  /// Vertices of cell a against vertices, edges and the face of cell b.
  void vertices_and_features(std::uint32_t a, std::uint32_t b) {
    const Cell& whole = features_.cells()[b];
    for (const VertexId v : features_.cells()[a].all()) {
      const std::array one = {v};
      if (whole.size == 3) add(FeaturePair::vertex_face, one, whole.all(), v, b);
      for (std::size_t k = 0; k < edges_of(whole); ++k) {
        const std::uint32_t e = whole.edges[k];
        add(FeaturePair::vertex_edge, one, features_.edges()[e], v, e);
      }
      for (const VertexId w : whole.all()) {
        add(FeaturePair::vertex_vertex, one, std::array{w}, std::min(v, w), std::max(v, w));
      }
    }
  }

  void edges_and_edges(const Cell& a, const Cell& b) {
    for (std::size_t i = 0; i < edges_of(a); ++i) {
      for (std::size_t k = 0; k < edges_of(b); ++k) {
        const auto [e, f] = std::minmax(a.edges[i], b.edges[k]);
        add(FeaturePair::edge_edge, features_.edges()[e], features_.edges()[f], e, f);
      }
    }
  }

  static std::size_t edges_of(const Cell& cell) { return cell.size == 3 ? 3 : cell.size - 1U; }

  const certificates::Features& features_;
  const Baseline& baseline_;
  std::vector<certificates::PairKey> keys_;
};

}  // namespace noli
