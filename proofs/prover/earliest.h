// SPDX-License-Identifier: Apache-2.0
//
// Which of many contacts is the first? Exact, although only a few times of impact are ever computed exactly.
//
// Notation
//   candidate  a contact whose enclosure begins no later than the least end of an enclosure seen so far: it may be the
//              first
//
// Contacts are ordered by exact first time, equal ones by canonical order (pair, then vertices), so the answer does not
// depend on the order in which they come.
//
// What this does not do: it does not find contacts.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <noli/time_of_impact.h>
#include "proofs/prover/verifier.h"

namespace noli {

/// Canonical order of pairs of features: by pair, then by vertices.
bool canonical_less(const FeatureContact& a, const FeatureContact& b);

/// Puts the vertices into the canonical order of FeatureContact.
FeatureContact canonical(FeaturePair pair, const std::array<VertexId, 4>& vertices, TimeEnclosure first);

/// The exact first time of a contact. Precondition: the pair meets.
TimeOfImpact exact_time(const FeatureContact& contact, std::span<const Position> x_t0, std::span<const Position> x_t1,
                        int dimension);

/// Collects contacts and keeps those that may be the first. Memory is bounded, however many there are.
class Earliest {
 public:
  /// Positions and dimension as in verify_step; the positions must outlive this.
  Earliest(std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension)
      : x_t0_(x_t0), x_t1_(x_t1), dimension_(dimension) {}

  void add(const FeatureContact& contact);
  void add(const Earliest& other);

  /// The first of all that were added, if any, with its time enclosed by neighbouring doubles.
  std::optional<FeatureContact> first();

 private:
  static constexpr std::size_t most_candidates = 256;

  void prune();
  void reduce();

  std::span<const Position> x_t0_, x_t1_;
  int dimension_;
  std::vector<FeatureContact> candidates_;
  double end_ = 1;  ///< the first contact is not later
};

}  // namespace noli
