// SPDX-License-Identifier: Apache-2.0
//
// The verifier's recursion over pairs of groups.
//
// Notation
//   obligation  as in proofs/prover/events.h: a pair of groups, or one with itself
//   grain       obligations about at most so many cells are put off, when a list to put them on is given: that is how
//               the work is cut into tasks which do not depend on the number of threads
//
// What this does not do: it makes no threads and adds nothing up.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <vector>

#include "noli/proofs/prover/cell_pair.h"
#include "noli/proofs/prover/hierarchy.h"

namespace noli {

/// A pair of groups, or a group with itself (then both are the same).
struct Obligation {
  Group first;
  Group second;
  bool self = false;
};

/// An obligation that was put off, after so many recorded steps.
struct Deferred {
  Obligation obligation;
  std::size_t steps_before = 0;
};

/// What a traversal reads.
template <int Dim>
struct Scene {
  const Hierarchy& hierarchy;
  const std::vector<MovingCell<Dim>>& cells;  ///< in the order of the leaves
};

/// When to give up. One object for all threads.
class StopSignal {
 public:
  explicit StopSignal(const VerifyOptions& options) : stop_(options.stop), deadline_(options.deadline) {}

  bool raised() const {
    return (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) ||
           (deadline_ && std::chrono::steady_clock::now() >= *deadline_);
  }

 private:
  const std::atomic<bool>* stop_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

template <int Dim>
class Traversal {
 public:
  Traversal(const Scene<Dim>& scene, const VerifyOptions& options, const StopSignal& stop, Tally& tally,
            StepRecord& record)
      : scene_(scene),
        first_only_(options.first_only),
        stop_(stop),
        tally_(tally),
        record_(record),
        cell_pairs_({options.initial, options.strict}, tally, record) {}

  /// From now on puts obligations about at most `grain` cells on the list.
  void defer(std::uint32_t grain, std::vector<Deferred>& list) {
    grain_ = grain;
    deferred_ = &list;
  }

  /// Settles an obligation. False if it was stopped, or found what first_only looks for, before the end.
  bool run(const Obligation& obligation) {
    stopped_ = stop_.raised();
    if (obligation.self) {
      settle_self(obligation.first);
    } else {
      settle(obligation.first, obligation.second);
    }
    return !stopped_;
  }

 private:
  /// How many pairs of groups are settled between two looks at the clock.
  static constexpr unsigned patience = 4096;

  bool put_off(const Obligation& obligation) {
    const std::uint32_t size = obligation.first.count + (obligation.self ? 0 : obligation.second.count);
    if (deferred_ == nullptr || size > grain_) return false;
    deferred_->push_back({obligation, record_.size()});
    return true;
  }

  void settle_self(Group g) {
    if (stopped_ || put_off({g, g, true})) return;
    if (g.is_leaf()) {
      cell_pairs_.settle_self(scene_.cells[g.begin]);
      return look_around();
    }
    record_.split_self();
    settle_self(g.left());
    settle(g.left(), g.right());
    settle_self(g.right());
  }

  void settle(Group a, Group b) {
    if (axis_separates(scene_.hierarchy.box(a), scene_.hierarchy.box(b))) {
      close(a, b);
    } else {
      take_apart(a, b);
    }
  }

  /// What `settle` does when no axis separates them. Not inlined, so that the test of an axis, which mostly succeeds,
  /// comes before the call.
  [[gnu::noinline]] void take_apart(Group a, Group b) {
    if (stopped_ || put_off({a, b, false})) return;
    if (++since_look_ >= patience) look_at_clock();
    if (a.is_leaf() && b.is_leaf()) {
      cell_pairs_.settle(scene_.cells[a.begin], scene_.cells[b.begin]);
      look_around();
    } else if (a.count >= b.count) {
      record_.split_first();
      settle(a.left(), b);
      settle(a.right(), b);
    } else {
      record_.split_second();
      settle(a, b.left());
      settle(a, b.right());
    }
  }

  void close(Group a, Group b) {
    ++tally_.obligations;
    if (record_.on()) record_.direction(separating_axis(scene_.hierarchy.box(a), scene_.hierarchy.box(b)));
  }

  void look_around() {
    if (first_only_ && tally_.found_any()) stopped_ = true;
  }

  void look_at_clock() {
    since_look_ = 0;
    if (stop_.raised()) stopped_ = true;
  }

  const Scene<Dim>& scene_;
  bool first_only_;
  const StopSignal& stop_;
  Tally& tally_;
  StepRecord& record_;
  CellPairs<Dim> cell_pairs_;
  std::uint32_t grain_ = 0;
  std::vector<Deferred>* deferred_ = nullptr;
  unsigned since_look_ = 0;
  bool stopped_ = false;
};

}  // namespace noli
