// SPDX-License-Identifier: Apache-2.0
//
// The recursion over pairs of groups in a span of a window: as proofs/prover/traversal.h, over bounds with radii.
// Groups of one part are settled at once where the part is monotone (proofs/prover/windows/monotone.h): a sheet in a
// rectangle around both, another part in a chart that holds both.
//
// What this does not do: it makes no threads and adds nothing up.
#pragma once

#include <vector>

#include "proofs/prover/traversal.h"
#include "proofs/prover/windows/window_boxes.h"
#include "proofs/prover/windows/window_pair.h"

namespace noli {

/// What a traversal of a span reads.
template <int Dim>
struct WindowScene {
  const WorldLines& lines;
  const Forest& forest;
  const WindowChords<Dim>& chords;
  const WindowBoxes<Dim>& boxes;
};

/// A pair of groups, or a group with itself.
struct WindowObligation {
  Obligation groups;
  const Tree* part;  ///< that both are groups of; nullptr: they are of different trees, or of that of the rest
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
        cell_pairs_(scene.lines, scene.forest.leftovers(), scene.chords.span, options, tally) {}

  /// From now on puts obligations about at most `grain` cells on the list.
  void defer(std::uint32_t grain, std::vector<WindowObligation>& list) {
    grain_ = grain;
    deferred_ = &list;
  }

  /// Settles an obligation. False if it was stopped, or found what first_only looks for, before the end.
  bool run(const WindowObligation& obligation) {
    stopped_ = stopped_ || stop_.raised();
    part_ = obligation.part;
    if (obligation.groups.self) {
      settle_self(obligation.groups.first);
    } else {
      settle(obligation.groups.first, obligation.groups.second);
    }
    return !stopped_;
  }

 private:
  /// How many pairs of groups are settled between two looks at the clock.
  static constexpr unsigned patience = 4096;
  /// Pairs of fewer cells are settled one by one without asking whether the sheet is monotone around them.
  static constexpr std::uint32_t worth_asking = 8;

  bool put_off(const Obligation& obligation) {
    const std::uint32_t size = obligation.first.count + (obligation.self ? 0 : obligation.second.count);
    if (deferred_ == nullptr || size > grain_) return false;
    deferred_->push_back({obligation, part_});
    return true;
  }

  void settle_self(Group g) {
    if (stopped_ || scene_.forest.scripted(g)) return;
    if (part_ != nullptr && monotone_around(g)) {
      ++tally_.obligations;
      return;
    }
    if (put_off({g, g, true})) return;
    if (g.is_leaf()) {
      if (!scene_.forest.excluded(scene_.forest.leaf(g), scene_.forest.leaf(g))) cell_pairs_.settle_self(cell(g));
      return look_around();
    }
    settle_self(g.left());
    settle(g.left(), g.right());
    settle_self(g.right());
  }

  void settle(Group a, Group b) {
    if (axis_separates(scene_.boxes.box(a), scene_.boxes.box(b))) {
      ++tally_.obligations;
    } else {
      take_apart(a, b);
    }
  }

  [[gnu::noinline]] void take_apart(Group a, Group b) {
    if (stopped_ || (scene_.forest.scripted(a) && scene_.forest.scripted(b))) return;
    if (++since_look_ >= patience) look_at_clock();
    if (part_ != nullptr && monotone_around(a, b)) {
      ++tally_.obligations;
      return;
    }
    if (put_off({a, b, false})) return;
    if (a.is_leaf() && b.is_leaf()) {
      if (!scene_.forest.excluded(scene_.forest.leaf(a), scene_.forest.leaf(b))) cell_pairs_.settle(cell(a), cell(b));
      look_around();
    } else if (a.count >= b.count) {
      settle(a.left(), b);
      settle(a.right(), b);
    } else {
      settle(a, b.left());
      settle(a, b.right());
    }
  }

  WindowCell<Dim> cell(Group g) const { return cell_of(scene_.forest.leaf(g), scene_.chords); }

  bool monotone_around(Group g) const {
    if (!part_->sheet) return holds_both(g, g);
    return g.count >= worth_asking && monotone_around(scene_.boxes.tangents(g), scene_.forest.extent(g));
  }

  bool monotone_around(Group a, Group b) const {
    if (!part_->sheet) return holds_both(a, b) || holds_both(b, a);
    if (a.count + b.count < worth_asking) return false;
    const TangentBox both = merged(scene_.boxes.tangents(a), scene_.boxes.tangents(b));
    return monotone_around(both, merged(scene_.forest.extent(a), scene_.forest.extent(b)));
  }

  /// Whether the chart of the first group is monotone and covers the second.
  bool holds_both(Group a, Group b) const {
    const Charts& charts = scene_.forest.charts();
    const std::uint32_t chart = charts.chart_of(a);
    return chart != Charts::none && scene_.boxes.monotone(chart) && charts.covers(chart, b);
  }

  /// Whether the sheet is monotone in a rectangle, given the tangents of some of its faces.
  bool monotone_around(TangentBox tangents, const Extent& extent) const {
    return is_monotone(tangents, Dim) && add_tangents(part_->root, extent, tangents);
  }

  /// Adds the tangents of the faces of a group that are laid out in a rectangle. False if nothing is monotone then.
  bool add_tangents(Group g, const Extent& extent, TangentBox& tangents) const {
    if (!scene_.forest.extent(g).meets(extent)) return true;
    const TangentBox more = merged(tangents, scene_.boxes.tangents(g));
    if (is_monotone(more, Dim)) {
      tangents = more;
      return true;
    }
    return !g.is_leaf() && add_tangents(g.left(), extent, tangents) && add_tangents(g.right(), extent, tangents);
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
  const Tree* part_ = nullptr;
  std::uint32_t grain_ = 0;
  std::vector<WindowObligation>* deferred_ = nullptr;
  unsigned since_look_ = 0;
  bool stopped_ = false;
};

}  // namespace noli
