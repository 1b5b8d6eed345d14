// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/window_verifier.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "kernel/parallel.h"
#include "proofs/prover/windows/span_cut.h"
#include "proofs/prover/windows/window_traversal.h"

namespace noli {

namespace {

/// As in verifier.cpp.
constexpr std::uint32_t grain_share = 256;
constexpr std::uint32_t least_grain = 64;

/// What one task leaves behind.
struct Outcome {
  WindowTally tally;
  bool finished = false;
};

VerifyOptions when_to_stop(const WindowOptions& options) {
  VerifyOptions result;
  result.stop = options.stop;
  result.deadline = options.deadline;
  return result;
}

/// What tells the caller how it goes: one thread at a time, never backwards.
class Progress {
 public:
  Progress(const WindowOptions& options, const WorldLines& lines)
      : options_(options), begin_(lines.first_time()), end_(lines.last_time()) {}

  /// So many of the tasks of a span are done.
  void begin(Span span, std::size_t tasks) {
    span_ = span;
    tasks_ = tasks;
    done_ = 0;
    if (tasks == 0) tell(share(span.end));
  }
  void task_done() {
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    ++done_;
    const double part = static_cast<double>(done_) / static_cast<double>(tasks_);
    tell(done_ == tasks_ ? share(span_.end) : share(span_.begin) + part * (share(span_.end) - share(span_.begin)));
  }

 private:
  double share(double t) const { return t == end_ ? 1 : (t - begin_) / (end_ - begin_); }

  void tell(double share) {
    if (!options_.progress || !(share > told_)) return;
    told_ = share;
    options_.progress(share);
  }

  const WindowOptions& options_;
  double begin_, end_;
  Span span_{};
  std::size_t tasks_ = 0, done_ = 0;
  double told_ = 0;
  std::mutex mutex_;
};

/// The walk over one span.
template <int Dim>
class SpanWalk {
 public:
  SpanWalk(const WorldLines& lines, const Forest& forest, const WindowChords<Dim>& chords, const WindowOptions& options,
           const StopSignal& stop, Progress& progress)
      : forest_(forest),
        options_(options),
        stop_(stop),
        progress_(progress),
        boxes_(forest, chords, options.threads),
        scene_{lines, forest, chords, boxes_},
        top_{WindowTally(options.max_reports, WindowEarliest(lines, Dim))} {}

  Outcome run() {
    const Outcome blank = top_;
    const std::vector<WindowObligation> open = settle_roots();
    cut_into_tasks(open);
    outcomes_.assign(tasks_.size(), blank);
    progress_.begin(scene_.chords.span, tasks_.size());
    parallel_for(tasks_.size(), options_.threads, [this](std::size_t i) { run_task(i); });
    add_up();
    return std::move(top_);
  }

 private:
  /// The obligations that are not settled for whole trees, with the bounds that they need.
  std::vector<WindowObligation> settle_roots() {
    const auto& trees = forest_.trees();
    std::vector<WindowObligation> open;
    std::vector<bool> needed(trees.size(), false);
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const Group a = trees[i].root;
      if (forest_.scripted(a)) continue;
      if (boxes_.root_monotone(i)) {
        ++top_.tally.obligations;
      } else {
        open.push_back({{a, a, true}, trees[i].part ? &trees[i] : nullptr});
        needed[i] = true;
      }
    }
    for (std::size_t i = 0; i < trees.size(); ++i) {
      for (std::size_t j = i + 1; j < trees.size(); ++j) {
        const Group a = trees[i].root, b = trees[j].root;
        if (forest_.scripted(a) && forest_.scripted(b)) continue;
        if (axis_separates(boxes_.root_box(i), boxes_.root_box(j))) {
          ++top_.tally.obligations;
        } else {
          open.push_back({{a, b, false}, nullptr});
          needed[i] = needed[j] = true;
        }
      }
    }
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < trees.size(); ++i) {
      if (needed[i]) list.push_back(i);
    }
    boxes_.make(list);
    return open;
  }

  /// Walks the top of the trees, where there is little to do, and lists what is below.
  void cut_into_tasks(const std::vector<WindowObligation>& open) {
    WindowTraversal<Dim> traversal(scene_, options_, stop_, top_.tally);
    const auto cells = static_cast<std::uint32_t>(forest_.leaves().size());
    traversal.defer(std::max(cells / grain_share, least_grain), tasks_);
    top_.finished = !stop_.raised();
    for (const WindowObligation& obligation : open) top_.finished = top_.finished && traversal.run(obligation);
  }

  void run_task(std::size_t i) {
    if (i > first_found_) return;
    Outcome& outcome = outcomes_[i];
    WindowTraversal<Dim> traversal(scene_, options_, stop_, outcome.tally);
    outcome.finished = traversal.run(tasks_[i]);
    if (options_.first_only && outcome.tally.found_any()) lower_first_found(i);
    progress_.task_done();
  }

  void lower_first_found(std::size_t i) {
    std::size_t before = first_found_;
    while (i < before && !first_found_.compare_exchange_weak(before, i)) {
    }
  }

  /// Tasks after the one that first_only ended at do not count: whether they ran depends on the threads.
  void add_up() {
    for (std::size_t i = 0; i < outcomes_.size() && i <= first_found_; ++i) {
      top_.tally += outcomes_[i].tally;
      top_.finished = top_.finished && outcomes_[i].finished;
    }
  }

  const Forest& forest_;
  const WindowOptions& options_;
  const StopSignal& stop_;
  Progress& progress_;
  WindowBoxes<Dim> boxes_;
  WindowScene<Dim> scene_;
  std::vector<WindowObligation> tasks_;
  std::vector<Outcome> outcomes_;
  std::atomic<std::size_t> first_found_ = std::numeric_limits<std::size_t>::max();
  Outcome top_;  ///< of the walk over the top, then the sum of all
};

/// One verification of one window.
template <int Dim>
class Verification {
 public:
  Verification(const WorldLines& lines, const Forest& forest, const WindowOptions& options)
      : lines_(lines),
        forest_(forest),
        options_(options),
        stop_(when_to_stop(options)),
        progress_(options, lines),
        sum_{WindowTally(options.max_reports, WindowEarliest(lines, Dim)), true} {}

  WindowResult run() {
    const Span window{lines_.first_time(), lines_.last_time()};
    WindowChords<Dim> chords = chords_over<Dim>(window, lines_, forest_, options_.threads);
    if (!cut_time(chords) || !settle_halves(window)) sum_ = walk(chords);
    WindowTally& sum = sum_.tally;
    return {
        sum_.finished,        sum.contacts, sum.initial_intersections, sum.reports.take(), sum.initial_reports.take(),
        sum.earliest.first(), sum.stages,   sum.obligations,           sum.cell_pairs};
  }

 private:
  static double middle(Span span) { return span.begin + 0.5 * (span.end - span.begin); }

  /// Whether shorter spans are worth their while.
  bool cut_time(const WindowChords<Dim>& chords) const {
    const double cut = middle(chords.span);
    return worth_cutting(chords.inside, chords.of.size(), [&] { return chords.restless; }) && chords.span.begin < cut &&
           cut < chords.span.end;
  }

  Outcome walk(const WindowChords<Dim>& chords) {
    return SpanWalk<Dim>(lines_, forest_, chords, options_, stop_, progress_).run();
  }

  /// False as soon as something meets.
  bool settle_span(Span span) {
    const WindowChords<Dim> chords = chords_over<Dim>(span, lines_, forest_, options_.threads);
    if (cut_time(chords)) return settle_halves(span);
    const Outcome outcome = walk(chords);
    if (outcome.tally.found_any()) return false;
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
  Outcome sum_;
};

std::vector<Position> begin_of(const WorldLines& lines) {
  std::vector<Position> x;
  x.reserve(lines.vertex_count());
  for (std::size_t v = 0; v < lines.vertex_count(); ++v) {
    x.push_back(lines.positions(static_cast<VertexId>(v)).front());
  }
  return x;
}

}  // namespace

WindowVerifier::WindowVerifier(const Mesh& mesh, std::span<const Position> x, const WindowOptions& options)
    : dimension_(options.dimension), strict_(options.strict) {
  if (mesh.cell_count() == 0) return;
  forest_ =
      std::make_unique<const Forest>(mesh, x, ForestOptions{dimension_, strict_, options.scripted, options.exclusions});
}

WindowVerifier::~WindowVerifier() = default;
WindowVerifier::WindowVerifier(WindowVerifier&&) noexcept = default;
WindowVerifier& WindowVerifier::operator=(WindowVerifier&&) noexcept = default;

WindowResult WindowVerifier::verify(const WorldLines& lines, const WindowOptions& options) const {
  if (forest_ == nullptr) return {};
  WindowOptions all = options;
  all.strict = strict_;
  return dimension_ == 2 ? Verification<2>(lines, *forest_, all).run() : Verification<3>(lines, *forest_, all).run();
}

WindowResult verify_window(const Mesh& mesh, const WorldLines& lines, const WindowOptions& options) {
  return WindowVerifier(mesh, begin_of(lines), options).verify(lines, options);
}

}  // namespace noli
