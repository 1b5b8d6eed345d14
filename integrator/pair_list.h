// SPDX-License-Identifier: Apache-2.0
//
// The pairs for which a layer is active, in the order of their keys. Many join and leave between two times at which the
// layer fires, so these are put into order together, then: n of them among N take O(N + n log n), not O(N n).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "certificates/stencil.h"

namespace noli::integrator {

class PairList {
 public:
  /// Precondition: the pair is not in the list.
  void add(const certificates::Stencil& pair) {
    changes_.push_back({pair, true});
    ++size_;
  }
  /// Precondition: the pair is in the list.
  void remove(const certificates::Stencil& pair) {
    changes_.push_back({pair, false});
    --size_;
  }

  bool empty() const { return size_ == 0; }

  /// By key. Stays as it is while pairs are added and removed, until it is asked for again.
  std::span<const certificates::Stencil> in_order() const {
    if (!changes_.empty()) settle();
    return pairs_;
  }

 private:
  struct Change {
    certificates::Stencil pair;
    bool joins;
  };

  /// Of several changes of one pair the last one holds.
  void settle() const {
    std::stable_sort(changes_.begin(), changes_.end(),
                     [](const Change& a, const Change& b) { return a.pair.key < b.pair.key; });
    merged_.clear();
    merged_.reserve(size_);
    auto old = pairs_.begin();
    for (auto change = changes_.begin(); change != changes_.end(); ++change) {
      if (change + 1 != changes_.end() && (change + 1)->pair.key == change->pair.key) continue;
      for (; old != pairs_.end() && old->key < change->pair.key; ++old) merged_.push_back(*old);
      if (old != pairs_.end() && old->key == change->pair.key) ++old;
      if (change->joins) merged_.push_back(change->pair);
    }
    merged_.insert(merged_.end(), old, pairs_.end());
    pairs_.swap(merged_);
    changes_.clear();
  }

  std::size_t size_ = 0;
  mutable std::vector<certificates::Stencil> pairs_, merged_;
  mutable std::vector<Change> changes_;
};

}  // namespace noli::integrator
