// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/window_verifier.h"

#include <algorithm>

#include "proofs/prover/task_walk.h"
#include "proofs/prover/windows/chords.h"

namespace noli {

namespace {

template <int Dim>
using WindowOutcome = WalkOutcome<Chords<Dim>, NoTokens>;

/// One verification of one window.
template <int Dim>
class Verification {
 public:
  Verification(const WorldLines& lines, const Forest& forest, const WindowOptions& options)
      : lines_(lines),
        forest_(forest),
        options_(options),
        stop_(options),
        progress_(options),
        none_(options.max_reports, {ExactlyInWindow{&lines, Dim}, lines.last_time()}),
        sum_{none_, {}, true} {}

  WindowResult run() {
    const Span window{lines_.first_time(), lines_.last_time()};
    WindowChords<Dim> chords = chords_over<Dim>(window, lines_, forest_, options_.threads);
    if (!cut_time(chords)) {
      sum_ = walk(chords);
    } else if (!settle_halves(window)) {
      sum_ = walk(chords);
      if (!sum_.finished && !sum_.tally.found_any() && met_) sum_ = std::move(*met_), sum_.finished = false;
    }
    return {sum_.tally.findings(sum_.finished), sum_.tally.earliest.first()};
  }

 private:
  static double middle(Span span) { return span.begin + 0.5 * (span.end - span.begin); }

  /// Whether shorter spans are worth the effort.
  bool cut_time(const WindowChords<Dim>& chords) const {
    const double cut = middle(chords.span);
    return chords.worth_cutting() && chords.span.begin < cut && cut < chords.span.end;
  }

  WindowOutcome<Dim> walk(const WindowChords<Dim>& chords) {
    WindowBoxes<Dim> boxes(forest_, chords, options_.threads);
    const Chords<Dim> positions(lines_, forest_, chords, boxes);
    TaskWalk<Chords<Dim>, NoTokens> walk(positions, options_, stop_, none_);
    const std::vector<Obligation> open = settle_roots(boxes, walk.sum().tally);
    walk.cut(forest_.leaves().size(), [&](auto& top) {
      return std::ranges::all_of(open, [&](const Obligation& obligation) { return top.run(obligation); });
    });
    progress_.begin(share(chords.span.begin), share(chords.span.end), walk.tasks().size());
    walk.run([&](std::size_t /*task*/) { progress_.task_done(); });
    return std::move(walk.sum());
  }

  /// The obligations that are not settled for whole trees. Makes the bounds that they need.
  std::vector<Obligation> settle_roots(WindowBoxes<Dim>& boxes, WindowTally& tally) const {
    const auto& trees = forest_.trees();
    std::vector<Obligation> open;
    std::vector<bool> needed(trees.size(), false);
    const auto settle = [&](std::size_t i, std::size_t j) {
      const Group a = trees[i].root, b = trees[j].root;
      if (forest_.left_out(a, b)) return;
      if (i == j ? boxes.root_monotone(i) : axis_separates(boxes.root_box(i), boxes.root_box(j))) {
        ++tally.obligations;
      } else {
        open.push_back({a, b});
        needed[i] = needed[j] = true;
      }
    };
    for (std::size_t i = 0; i < trees.size(); ++i) settle(i, i);
    for (std::size_t i = 0; i < trees.size(); ++i) {
      for (std::size_t j = i + 1; j < trees.size(); ++j) settle(i, j);
    }
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < trees.size(); ++i) {
      if (needed[i]) list.push_back(i);
    }
    boxes.make(list);
    return open;
  }

  /// The share of the window before a time.
  double share(double t) const {
    const double begin = lines_.first_time(), end = lines_.last_time();
    return t == end ? 1 : (t - begin) / (end - begin);
  }

  /// False as soon as something meets.
  bool settle_span(Span span) {
    if (!sum_.finished) return true;
    const WindowChords<Dim> chords = chords_over<Dim>(span, lines_, forest_, options_.threads);
    if (cut_time(chords)) return settle_halves(span);
    WindowOutcome<Dim> outcome = walk(chords);
    if (outcome.tally.found_any()) {
      // What a later span meets may go on since the beginning of the window.
      if (!options_.after_step || span.begin == lines_.first_time()) met_ = std::move(outcome);
      return false;
    }
    sum_.tally += outcome.tally;
    sum_.finished = sum_.finished && outcome.finished;
    return true;
  }

  bool settle_halves(Span span) {
    return settle_span({span.begin, middle(span)}) && settle_span({middle(span), span.end});
  }

  const WorldLines& lines_;
  const Forest& forest_;
  const WindowOptions& options_;
  StopSignal stop_;
  Progress progress_;
  WindowTally none_;
  WindowOutcome<Dim> sum_;
  std::optional<WindowOutcome<Dim>> met_;  ///< of the span in which something certainly new met
};

}  // namespace

WindowVerifier::WindowVerifier(const Mesh& mesh, std::span<const Position> x, const WindowOptions& options)
    : dimension_(options.dimension), strict_(options.strict) {
  if (mesh.cell_count() == 0) return;
  forest_ = std::make_shared<const Forest>(mesh, x, options);
}

WindowResult WindowVerifier::verify(const WorldLines& lines, const WindowOptions& options) const {
  if (forest_ == nullptr) return {};
  WindowOptions all = options;
  all.strict = strict_;
  return dimension_ == 2 ? Verification<2>(lines, *forest_, all).run() : Verification<3>(lines, *forest_, all).run();
}

}  // namespace noli
