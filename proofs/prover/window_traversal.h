// SPDX-License-Identifier: Apache-2.0
//
// The recursion over pairs of groups in a window: as proofs/prover/traversal.h, over boxes with radii.
//
// What this does not do: it makes no threads and adds nothing up.
#pragma once

#include <vector>

#include "noli/proofs/prover/traversal.h"
#include "noli/proofs/prover/window_boxes.h"
#include "noli/proofs/prover/window_pair.h"

namespace noli {

/// What a traversal of a window reads.
template <int Dim>
struct WindowScene {
  const WorldLines& lines;
  const std::vector<WindowCell<Dim>>& cells;  ///< in the order of the leaves
  const std::vector<GroupBox>& boxes;         ///< by node
};

template <int Dim>
class WindowTraversal {
 public:
  WindowTraversal(const WindowScene<Dim>& scene, const WindowOptions& options, const StopSignal& stop,
                  WindowTally& tally)
      : scene_(scene),
        first_only_(options.first_only),
        stop_(stop),
        tally_(tally),
        cell_pairs_(scene.lines, options, tally) {}

  /// From now on puts obligations about at most `grain` cells on the list.
  void defer(std::uint32_t grain, std::vector<Obligation>& list) {
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
    deferred_->push_back(obligation);
    return true;
  }

  void settle_self(Group g) {
    if (stopped_ || put_off({g, g, true})) return;
    if (g.is_leaf()) {
      cell_pairs_.settle_self(scene_.cells[g.begin]);
      return look_around();
    }
    settle_self(g.left());
    settle(g.left(), g.right());
    settle_self(g.right());
  }

  void settle(Group a, Group b) {
    if (axis_separates(scene_.boxes[a.node], scene_.boxes[b.node])) {
      ++tally_.obligations;
    } else {
      take_apart(a, b);
    }
  }

  [[gnu::noinline]] void take_apart(Group a, Group b) {
    if (stopped_ || put_off({a, b, false})) return;
    if (++since_look_ >= patience) look_at_clock();
    if (a.is_leaf() && b.is_leaf()) {
      cell_pairs_.settle(scene_.cells[a.begin], scene_.cells[b.begin]);
      look_around();
    } else if (a.count >= b.count) {
      settle(a.left(), b);
      settle(a.right(), b);
    } else {
      settle(a, b.left());
      settle(a, b.right());
    }
  }

  void look_around() {
    if (first_only_ && tally_.found_any()) stopped_ = true;
  }

  void look_at_clock() {
    since_look_ = 0;
    if (stop_.raised()) stopped_ = true;
  }

  const WindowScene<Dim>& scene_;
  bool first_only_;
  const StopSignal& stop_;
  WindowTally& tally_;
  WindowPairs<Dim> cell_pairs_;
  std::uint32_t grain_ = 0;
  std::vector<Obligation>* deferred_ = nullptr;
  unsigned since_look_ = 0;
  bool stopped_ = false;
};

}  // namespace noli
