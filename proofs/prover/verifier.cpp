// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/verifier.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>

#include "proofs/prover/pieces.h"
#include "proofs/prover/traversal.h"

namespace noli {

namespace {

/// The work is cut into obligations about at most this share of the cells, but no fewer than least_grain of them.
constexpr std::uint32_t grain_share = 256;
constexpr std::uint32_t least_grain = 256;

/// What one task leaves behind.
struct Outcome {
  Tally tally;
  StepRecord record;
  bool finished = false;
};

/// What tells the caller how it goes: one thread at a time.
class Reporter {
 public:
  Reporter(const VerifyOptions& options, std::size_t tasks) : options_(options), ready_(tasks, false) {}

  /// Task i is done; `play(k)` is called for each k, in order, as soon as the tasks up to k are done. k does not go
  /// beyond `last`.
  template <class Play>
  void done(std::size_t i, std::size_t last, const Play& play) {
    if (options_.sink == nullptr && !options_.progress) return;
    const std::lock_guard lock(mutex_);
    ready_[i] = true;
    ++done_;
    if (options_.progress) options_.progress(static_cast<double>(done_) / static_cast<double>(ready_.size()));
    if (options_.sink == nullptr) return;
    for (; played_ < ready_.size() && played_ <= last && ready_[played_]; ++played_) play(played_);
  }

 private:
  const VerifyOptions& options_;
  std::mutex mutex_;
  std::vector<bool> ready_;
  std::size_t done_ = 0;
  std::size_t played_ = 0;
};

/// One verification of one step.
template <int Dim>
class Verification {
 public:
  Verification(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
               const VerifyOptions& options)
      : options_(options), stop_(options), none_(x_t0, x_t1, Dim), top_(blank()) {
    CellFeatures features;
    parallel_both(
        options.threads, [&] { hierarchy_.emplace(mesh, x_t0, x_t1, Dim, options.threads); },
        [&] { features = find_owners(mesh, options.strict); });
    gather_vertices(x_t0, x_t1);
    gather_cells(mesh, features);
  }

  VerifyResult run() {
    if (options_.sink != nullptr) options_.sink->begin_step(hierarchy_->leaf_cells());
    cut_into_tasks();
    outcomes_.resize(tasks_.size());
    reporter_.emplace(options_, tasks_.size());
    parallel_for(tasks_.size(), options_.threads, [this](std::size_t i) { run_task(i); });
    VerifyResult result = add_up();
    if (options_.sink != nullptr) finish_playing(result.complete);
    return result;
  }

 private:
  Outcome blank() const { return {Tally(options_.max_reports, none_), StepRecord(options_.sink != nullptr), false}; }

  void gather_vertices(std::span<const Position> x_t0, std::span<const Position> x_t1) {
    vertices_ = std::make_unique_for_overwrite<MovingVertex<Dim>[]>(x_t0.size());
    for_each_in_pieces(x_t0.size(), options_.threads,
                       [&](std::size_t v) { vertices_[v] = moving_vertex<Dim>(x_t0[v], x_t1[v]); });
  }

  void gather_cells(const Mesh& mesh, const CellFeatures& features) {
    const auto order = hierarchy_->leaf_cells();
    cells_ = std::make_unique_for_overwrite<StepCell<Dim>[]>(order.size());
    for_each_in_pieces(order.size(), options_.threads, [&](std::size_t i) {
      cells_[i] = {names_of(mesh, features, order[i]), vertices_.get()};
    });
    leftovers_.emplace(order.size(), [this](std::size_t i) {
      return Leftovers::NumberedShape{shape_of(cells_[i]), cells_[i].cell};
    });
  }

  /// Walks the top of the tree, where there is little to do, and lists what is below.
  void cut_into_tasks() {
    const Scene<Dim> scene{*hierarchy_, cells_.get(), *leftovers_};
    Traversal<Dim> traversal(scene, options_, stop_, top_.tally, top_.record);
    const Group root = hierarchy_->root();
    traversal.defer(std::max(root.count / grain_share, least_grain), tasks_);
    top_.finished = traversal.run({root, root, true});
  }

  void run_task(std::size_t i) {
    if (i > first_found_) return;
    const Scene<Dim> scene{*hierarchy_, cells_.get(), *leftovers_};
    outcomes_[i] = std::make_unique<Outcome>(blank());
    Outcome& outcome = *outcomes_[i];
    Traversal<Dim> traversal(scene, options_, stop_, outcome.tally, outcome.record);
    outcome.finished = traversal.run(tasks_[i].obligation);
    if (options_.first_only && outcome.tally.found_any()) lower_first_found(i);
    reporter_->done(i, first_found_, [this](std::size_t k) { play_task(k); });
  }

  void lower_first_found(std::size_t i) {
    std::size_t before = first_found_;
    while (i < before && !first_found_.compare_exchange_weak(before, i)) {
    }
  }

  void play_task(std::size_t i) {
    top_.record.play(i == 0 ? 0 : tasks_[i - 1].steps_before, tasks_[i].steps_before, *options_.sink);
    outcomes_[i]->record.play(*options_.sink);
    outcomes_[i]->record.release();
  }

  void finish_playing(bool complete) {
    const std::size_t last = tasks_.empty() ? 0 : tasks_.back().steps_before;
    if (complete) top_.record.play(last, top_.record.size(), *options_.sink);
    options_.sink->end_step(complete);
  }

  /// Tasks after the one that first_only ended at do not count: whether they ran depends on the threads.
  VerifyResult add_up() {
    bool complete = top_.finished;
    for (std::size_t i = 0; i < outcomes_.size() && i <= first_found_; ++i) {
      top_.tally += outcomes_[i]->tally;
      complete = complete && outcomes_[i]->finished;
    }
    Tally& sum = top_.tally;
    return {complete,
            sum.contacts,
            sum.initial_intersections,
            sum.reports.take(),
            sum.initial_reports.take(),
            sum.earliest.first(),
            sum.stages,
            sum.obligations,
            sum.cell_pairs};
  }

  const VerifyOptions& options_;
  StopSignal stop_;
  std::optional<Hierarchy> hierarchy_;
  std::unique_ptr<MovingVertex<Dim>[]> vertices_;
  std::unique_ptr<StepCell<Dim>[]> cells_;  ///< in the order of the leaves
  std::optional<Leftovers> leftovers_;
  std::vector<Deferred> tasks_;
  std::vector<std::unique_ptr<Outcome>> outcomes_;  ///< of the tasks that have begun
  std::optional<Reporter> reporter_;
  std::atomic<std::size_t> first_found_ = std::numeric_limits<std::size_t>::max();
  Earliest none_;
  Outcome top_;  ///< of the walk over the top, then the sum of all
};

}  // namespace

VerifyResult verify_step(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
                         const VerifyOptions& options) {
  if (mesh.cell_count() == 0) return {};
  return options.dimension == 2 ? Verification<2>(mesh, x_t0, x_t1, options).run()
                                : Verification<3>(mesh, x_t0, x_t1, options).run();
}

}  // namespace noli
