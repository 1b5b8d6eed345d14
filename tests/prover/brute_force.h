// SPDX-License-Identifier: Apache-2.0
//
// Computes the verifier's answer by its definition: all pairs of features and all pairs of cells, one by one, in
// rational arithmetic.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "oracle/oracle.h"
#include "proofs/prover/verifier.h"
#include "scenes.h"

namespace noli::testing {

/// A pair of features, as in FeatureContact.
using PairKey = std::pair<FeaturePair, std::array<VertexId, 4>>;

PairKey key_of(const FeatureContact& contact);

/// Puts the vertices of a pair into canonical order: each edge, and the two edges of a pair, ascending; two points
/// ascending.
PairKey canonical_key(FeaturePair pair, std::array<VertexId, 4> vertices);

/// All pairs of features that the verifier must decide, and how often each counts. A face that is listed twice counts
/// twice.
std::map<PairKey, int> all_pairs(const Mesh& mesh, int dimension, bool strict);

/// The oracle's answer for a pair.
oracle::Answer decide(const PairKey& key, const Step& step, int dimension);

struct BruteForce {
  std::map<PairKey, int> contacts;
  std::set<std::pair<std::uint32_t, std::uint32_t>> initial;
  std::optional<oracle::Time> first_time;
  std::set<PairKey> first;  ///< the pairs that meet at the first time
};

BruteForce brute_force(const Step& step, int dimension, bool strict = false);

/// The negated claim: whether any two features of two different cells that share no vertex meet during the step.
bool ever_meet(const Step& step, int dimension);

/// Whether the vertex-disjoint parts of two cells meet at t = 0.
bool cells_meet_at_begin(const Step& step, int dimension, std::uint32_t a, std::uint32_t b);

}  // namespace noli::testing
