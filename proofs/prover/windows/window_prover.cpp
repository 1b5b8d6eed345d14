// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <mutex>

#include "proofs/prover/task_walk.h"
#include "proofs/prover/windows/chords.h"
#include "proofs/prover/windows/window_verifier.h"

namespace noli {

namespace {

using Take = std::function<void(std::string_view)>;

/// Walks over the roots of all trees, joined by a tree over their list, and writes their tokens.
template <int Dim>
class RootWalk {
 public:
  using TreeWalk = Traversal<Chords<Dim>, Tokens>;

  RootWalk(const Forest& forest, const WindowBoxes<Dim>& boxes, Tokens& tokens, TreeWalk& below)
      : trees_(forest.trees()), tokens_(tokens), below_(below), boxes_(2 * trees_.size() - 1) {
    join({0, 0, static_cast<std::uint32_t>(trees_.size())}, boxes);
  }

  bool run() { return self({0, 0, static_cast<std::uint32_t>(trees_.size())}); }

 private:
  void join(Group g, const WindowBoxes<Dim>& boxes) {
    if (g.is_leaf()) {
      boxes_[g.node] = boxes.root_box(g.begin);
      return;
    }
    join(g.left(), boxes);
    join(g.right(), boxes);
    boxes_[g.node] = merged(boxes_[g.left().node], boxes_[g.right().node]);
  }

  Group root(Group g) const { return trees_[g.begin].root; }

  bool self(Group g) {
    if (g.is_leaf()) return below_.run({root(g), root(g)});
    tokens_.parts();
    return self(g.left()) && pair(g.left(), g.right()) && self(g.right());
  }

  bool pair(Group a, Group b) {
    if (const unsigned axes = separating_axes(boxes_[a.node], boxes_[b.node]); axes != 0) {
      tokens_.axis(Tokens::axis_code_of(axes));
      return true;
    }
    if (a.is_leaf() && b.is_leaf()) return below_.run({root(a), root(b)});
    if (a.count >= b.count) {
      tokens_.left();
      return pair(a.left(), b) && pair(a.right(), b);
    }
    tokens_.right();
    return pair(a, b.left()) && pair(a, b.right());
  }

  const std::vector<Tree>& trees_;
  Tokens& tokens_;
  TreeWalk& below_;
  std::vector<GroupBox> boxes_;  ///< of the groups of trees
};

/// The proof of one window.
template <int Dim>
class Proof {
 public:
  Proof(const WorldLines& lines, const Forest& forest, const VerifyOptions& options, const LeastDistance& distance,
        const Take& take)
      : lines_(lines),
        forest_(forest),
        options_(options),
        distance_(distance),
        take_(take),
        stop_(options),
        none_(0, {ExactlyInWindow{&lines, Dim}, lines.last_time()}) {}

  bool settle(const Piece& span) {
    WindowChords<Dim> chords =
        chords_over<Dim>(*span.times(lines_), lines_, forest_, options_.threads, distance_.eta / 2);
    if (!chords.worth_cutting() || !span.half(0).times(lines_) || !span.half(1).times(lines_))
      return write(span, chords);
    Tokens halve;
    halve.halve();
    halve.give(take_);
    chords = {};
    return settle(span.half(0)) && settle(span.half(1));
  }

 private:
  bool write(const Piece& span, const WindowChords<Dim>& chords) {
    WindowBoxes<Dim> boxes(forest_, chords, options_.threads, false);
    std::vector<std::size_t> all(forest_.trees().size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    boxes.make(all);
    const SpanProof proof{span, distance_.eta, distance_.paths, stop_};
    const Chords<Dim> positions(lines_, forest_, chords, boxes, &proof);
    TaskWalk<Chords<Dim>, Tokens> walk(positions, options_, stop_, none_);
    Tokens& top = walk.sum().out.tokens;
    walk.cut(forest_.leaves().size(), [&](auto& below) { return RootWalk<Dim>(forest_, boxes, top, below).run(); });
    return give_in_order(walk);
  }

  bool give_in_order(TaskWalk<Chords<Dim>, Tokens>& walk) const {
    const Tokens& top = walk.sum().out.tokens;
    const auto& tasks = walk.tasks();
    std::mutex mutex;
    std::vector<bool> ready(tasks.size(), false);
    std::size_t given = 0, place = 0;
    bool failed = false;  // `take` has thrown; nothing may be given twice
    walk.run([&](std::size_t task) {
      const std::lock_guard lock(mutex);
      ready[task] = walk.outcome(task).finished;
      if (std::exchange(failed, true)) return;
      for (; given < tasks.size() && ready[given]; ++given) {
        top.give(place, tasks[given].tokens_before, take_);
        place = tasks[given].tokens_before;
        walk.outcome(given).out.tokens.give(take_);
        walk.outcome(given).out.tokens = {};
      }
      failed = false;
    });
    if (!walk.sum().finished) return false;
    top.give(place, top.place(), take_);
    return true;
  }

  const WorldLines& lines_;
  const Forest& forest_;
  const VerifyOptions& options_;
  const LeastDistance& distance_;
  const Take& take_;
  StopSignal stop_;
  WindowTally none_;
};

}  // namespace

std::string WindowVerifier::encoded_tree() const { return forest_->encoded(); }

bool WindowVerifier::prove(const WorldLines& lines, const VerifyOptions& options, const LeastDistance& distance,
                           const Take& take) const {
  VerifyOptions all;
  all.threads = options.threads;
  all.stop = options.stop;
  all.deadline = options.deadline;
  all.strict = strict_;
  TokenBlocks blocks(take);
  const Take put = [&](std::string_view bytes) { blocks(bytes); };
  const Piece whole{Integer(0), 0};
  const bool finished = dimension_ == 2 ? Proof<2>(lines, *forest_, all, distance, put).settle(whole)
                                        : Proof<3>(lines, *forest_, all, distance, put).settle(whole);
  blocks.flush();
  return finished;
}

}  // namespace noli
