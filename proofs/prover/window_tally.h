// SPDX-License-Identifier: Apache-2.0
//
// What one task of the verification of a window has found; the tallies of all tasks, added up in order, are the result.
#pragma once

#include <algorithm>

#include "noli/proofs/prover/tally.h"
#include "noli/proofs/prover/window_earliest.h"

namespace noli {

struct WindowTally {
  WindowTally(std::size_t max_reports, const WindowEarliest& none)
      : reports(max_reports), initial_reports(max_reports), earliest(none) {}

  std::array<std::uint64_t, all_feature_pairs.size()> contacts{};
  std::uint64_t initial_intersections = 0;
  Least<FeatureContact, canonical_less> reports;
  Least<InitialIntersection, initial_less> initial_reports;
  WindowEarliest earliest;
  StageCounters stages;
  std::uint64_t obligations = 0;
  std::uint64_t cell_pairs = 0;

  bool found_any() const {
    return initial_intersections > 0 || std::any_of(contacts.begin(), contacts.end(), [](auto n) { return n > 0; });
  }

  void add_contact(const FeatureContact& contact) {
    ++contacts[static_cast<std::size_t>(contact.pair)];
    reports.add(contact);
    earliest.add(contact);
  }

  void add_initial(std::uint32_t a, std::uint32_t b) {
    ++initial_intersections;
    initial_reports.add({std::min(a, b), std::max(a, b)});
  }

  WindowTally& operator+=(const WindowTally& other) {
    for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i] += other.contacts[i];
    initial_intersections += other.initial_intersections;
    reports.add(other.reports);
    initial_reports.add(other.initial_reports);
    earliest.add(other.earliest);
    stages += other.stages;
    obligations += other.obligations;
    cell_pairs += other.cell_pairs;
    return *this;
  }
};

}  // namespace noli
