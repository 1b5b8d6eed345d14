// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/claim_oracle.h"

#include <algorithm>
#include <map>

#include "audit/fuzz/trajectories/motion_oracle.h"

namespace noli::audit {

namespace {

class ClaimOracle {
 public:
  ClaimOracle(const ParsedClaim& claim, const Mesh& mesh) : claim_(claim), cells_(cells_of(mesh)) {
    for (const Feature& cell : cells_) {
      for (const VertexId v : cell) {
        for (const VertexId w : cell) neighbours_[v].insert(w);
      }
    }
  }

  bool holds(const std::vector<Position>& begin, const std::vector<Position>& end) const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      for (std::size_t j = claim_.strict ? i : i + 1; j < cells_.size(); ++j) {
        if (!excluded(i, j) && violated(begin, end, cells_[i], cells_[j])) return false;
      }
    }
    return true;
  }

 private:
  bool excluded(std::size_t i, std::size_t j) const {
    const std::uint32_t a = claim_.label(i), b = claim_.label(j);
    return claim_.excluded.contains({std::min(a, b), std::max(a, b)});
  }

  bool violated(const std::vector<Position>& begin, const std::vector<Position>& end, const Feature& a,
                const Feature& b) const {
    const bool flat = claim_.dimension == 2;
    const std::size_t most = flat ? 3 : 4;
    if (boxes_apart(claim_.dimension, begin, end, a, b, claim_.eta)) return false;
    const auto meets = [&](const FeatureTwo& pair) {
      return first_within(claim_.dimension, begin, end, pair, 0).has_value();
    };
    if (std::ranges::any_of(largest(disjoint_pairs(a, b, most)), meets)) return true;
    const auto meet_at_begin = [&](const FeatureTwo& pair) { return meet_at_rest(begin, pair, flat); };
    if (std::ranges::any_of(largest(disjoint_pairs(a, b, 5)), meet_at_begin)) return true;
    if (claim_.eta == 0) return false;
    // Without a ring no pair is joined, and what is near is so as part of a larger one too.
    const auto pairs = disjoint_pairs(a, b, most);
    return std::ranges::any_of(claim_.ring == 1 ? largest(pairs) : pairs, [&](const FeatureTwo& pair) {
      return !joined(pair) && first_within(claim_.dimension, begin, end, pair, claim_.eta).has_value();
    });
  }

  /// Whether a path of fewer edges than the ring joins a vertex of the one to one of the other.
  bool joined(const FeatureTwo& pair) const {
    std::set<VertexId> reached(pair[0].begin(), pair[0].end());
    for (std::uint32_t edges = 1; edges < claim_.ring; ++edges) {
      std::set<VertexId> next = reached;
      for (const VertexId v : reached) next.insert(neighbours_.at(v).begin(), neighbours_.at(v).end());
      if (next == reached) break;
      reached = std::move(next);
    }
    return std::ranges::any_of(pair[1], [&](VertexId v) { return reached.contains(v); });
  }

  const ParsedClaim& claim_;
  std::vector<Feature> cells_;
  std::map<VertexId, std::set<VertexId>> neighbours_;
};

}  // namespace

bool claim_holds(const ParsedClaim& claim, const Mesh& claimed, const std::vector<std::vector<Position>>& frames) {
  const ClaimOracle oracle(claim, claimed);
  const bool rest = claim.source == 1;
  for (std::size_t k = 0; k + (rest ? 0 : 1) < frames.size(); ++k) {
    if (!oracle.holds(frames[k], frames[rest ? k : k + 1])) return false;
  }
  return true;
}

}  // namespace noli::audit
