// SPDX-License-Identifier: Apache-2.0
//
// Finds the first of many contacts exactly, although it computes only a few times of impact exactly.
//
// Notation
//   candidate  a contact whose enclosure begins no later than the least end of an enclosure seen so far: it may be the
//              first
//
// Contacts are ordered by exact first time, ties by canonical order (pair, then vertices), so the answer does not
// depend on the order in which they are added.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <noli/time_of_impact.h>
#include "proofs/prover/verifier.h"

namespace noli {

/// Canonical order of pairs of features: by pair, then by vertices.
bool canonical_less(const FeatureContact& a, const FeatureContact& b);

/// Puts the vertices into the canonical order of FeatureContact.
FeatureContact canonical(FeaturePair pair, const std::array<VertexId, 4>& vertices, TimeEnclosure first);

/// A contact with its exact first time; the ends of `contact.first` are neighbouring doubles around it, or equal to it.
struct ContactAtTime {
  FeatureContact contact;
  TimeOfImpact time;
};

/// Decides contacts of a step exactly. Positions and dimension as in verify_step; the positions must outlive this.
struct ExactlyInStep {
  std::span<const Position> x_t0, x_t1;
  int dimension;

  /// Precondition: the pair meets.
  ContactAtTime operator()(const FeatureContact& contact) const;
};

/// Collects contacts and keeps those that may be the first, in bounded memory. `Exactly` decides a contact exactly; its
/// result has `contact` and `time`, like ContactAtTime.
template <class Exactly>
class EarliestOf {
 public:
  using First = std::invoke_result_t<const Exactly&, const FeatureContact&>;

  /// No contact is later than `last`.
  EarliestOf(const Exactly& exactly, double last) : exactly_(exactly), end_(last) {}

  void add(const FeatureContact& contact) {
    if (contact.first.begin > end_) return;
    candidates_.push_back(contact);
    if (contact.first.end < end_) {
      end_ = contact.first.end;
      std::erase_if(candidates_, [this](const FeatureContact& c) { return c.first.begin > end_; });
    }
    if (candidates_.size() > most_candidates) candidates_ = {reduce().contact};
  }

  void add(const EarliestOf& other) {
    for (const FeatureContact& contact : other.candidates_) add(contact);
  }

  /// The first of all that were added, if any.
  std::optional<First> first() {
    if (candidates_.empty()) return std::nullopt;
    return reduce();
  }

 private:
  static constexpr std::size_t most_candidates = 256;

  /// Whether both times are the same double. Such times are not computed exactly: thousands of pairs may begin in
  /// contact.
  static bool at_one_double(const TimeEnclosure& a, const TimeEnclosure& b) {
    return a.begin == a.end && a.begin == b.begin && a.end == b.end;
  }

  /// The first candidate. Precondition: there is one.
  First reduce() {
    std::ranges::sort(candidates_, [](const FeatureContact& a, const FeatureContact& b) {
      return a.first.end != b.first.end ? a.first.end < b.first.end : canonical_less(a, b);
    });
    First best = exactly_(candidates_.front());
    for (const FeatureContact& other : std::span(candidates_).subspan(1)) {
      if (other.first.begin > best.contact.first.end) continue;
      if (at_one_double(other.first, best.contact.first) && !canonical_less(other, best.contact)) continue;
      First next = exactly_(other);
      const auto order = next.time <=> best.time;
      if (order < 0 || (order == 0 && canonical_less(other, best.contact))) best = std::move(next);
    }
    end_ = best.contact.first.end;
    return best;
  }

  Exactly exactly_;
  std::vector<FeatureContact> candidates_;
  double end_;  ///< the first contact is not later
};

}  // namespace noli
