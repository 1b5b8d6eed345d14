// SPDX-License-Identifier: Apache-2.0
//
// Which of many contacts in a window is the first? As proofs/prover/earliest.h, for world lines.
//
// What this does not do: it does not find contacts.
#pragma once

#include <optional>
#include <vector>

#include "proofs/prover/windows/window_verifier.h"

namespace noli {

/// Collects contacts and keeps those that may be the first. Memory is bounded, however many there are.
class WindowEarliest {
 public:
  /// The lines must outlive this. Dimension as in WindowOptions.
  WindowEarliest(const WorldLines& lines, int dimension)
      : lines_(&lines), dimension_(dimension), end_(lines.last_time()) {}

  void add(const FeatureContact& contact);
  void add(const WindowEarliest& other);

  /// The first of all that were added, if any.
  std::optional<FirstInWindow> first();

 private:
  static constexpr std::size_t most_candidates = 256;

  FirstInWindow reduce();
  FirstInWindow exactly(const FeatureContact& contact) const;

  const WorldLines* lines_;
  int dimension_;
  std::vector<FeatureContact> candidates_;
  double end_;  ///< the first contact is not later
};

}  // namespace noli
