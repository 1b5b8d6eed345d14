// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/verifier.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>

#include "kernel/parallel.h"
#include "proofs/prover/traversal.h"

namespace noli {

namespace {

/// The work is cut into obligations about at most this share of the cells, but no fewer than least_grain of them.
constexpr std::uint32_t grain_share = 256;
constexpr std::uint32_t least_grain = 256;

/// What one task leaves behind.
template <int Dim, class Out>
struct Outcome {
  Tally tally;
  WalkTokens<Dim, Out> out;
  bool finished = false;
};

/// What tells the caller how it goes: one thread at a time.
class Reporter {
 public:
  Reporter(const VerifyOptions& options, std::size_t tasks) : options_(options), tasks_(tasks) {}

  /// One task more is done.
  void done() {
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    options_.progress(static_cast<double>(++done_) / static_cast<double>(tasks_));
  }

 private:
  const VerifyOptions& options_;
  std::mutex mutex_;
  std::size_t tasks_;
  std::size_t done_ = 0;
};

/// One verification of one step. `Out`: Tokens, or NoTokens.
template <int Dim, class Out>
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
    cut_into_tasks();
    outcomes_.resize(tasks_.size());
    reporter_.emplace(options_, tasks_.size());
    parallel_for(tasks_.size(), options_.threads, [this](std::size_t i) { run_task(i); });
    VerifyResult result = add_up();
    if constexpr (Out::on) {
      if (result.complete && !top_.tally.found_any()) {
        result.proof = prove();
        result.complete = result.proof != nullptr || !stop_.raised();
      }
    }
    return result;
  }

 private:
  using TaskOutcome = Outcome<Dim, Out>;

  TaskOutcome blank() const { return {Tally(options_.max_reports, none_), {}, false}; }

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
    Traversal<Dim, Out> traversal(scene, options_, stop_, top_.tally, top_.out);
    const Group root = hierarchy_->root();
    traversal.defer(std::max(root.count / grain_share, least_grain), tasks_);
    top_.finished = traversal.run({root, root, true});
  }

  void run_task(std::size_t i) {
    if (i > first_found_) return;
    const Scene<Dim> scene{*hierarchy_, cells_.get(), *leftovers_};
    outcomes_[i] = std::make_unique<TaskOutcome>(blank());
    TaskOutcome& outcome = *outcomes_[i];
    Traversal<Dim, Out> traversal(scene, options_, stop_, outcome.tally, outcome.out);
    outcome.finished = traversal.run(tasks_[i].obligation);
    if (options_.first_only && outcome.tally.found_any()) lower_first_found(i);
    reporter_->done();
  }

  void lower_first_found(std::size_t i) {
    std::size_t before = first_found_;
    while (i < before && !first_found_.compare_exchange_weak(before, i)) {
    }
  }

  /// Puts together what the tasks have written. Nothing where parts are left that no direction separates, or it was
  /// stopped.
  std::shared_ptr<const StepProof> prove() {
    auto proof = std::make_shared<StepProof>();
    const auto order = hierarchy_->leaf_cells();
    proof->leaf_cells.assign(order.begin(), order.end());
    JoinedTokens& all = proof->tokens;
    all.tokens = std::move(top_.out.tokens);
    for (const Deferred& task : tasks_) all.places.push_back(task.tokens_before);
    all.inserted.resize(tasks_.size());
    std::atomic<bool> whole = true;
    parallel_for(tasks_.size(), options_.threads, [&](std::size_t i) {
      if (whole && !close_open_parts(outcomes_[i]->out, all.inserted[i])) whole = false;
    });
    return whole ? proof : nullptr;
  }

  bool close_open_parts(WalkTokens<Dim, Out>& out, JoinedTokens& tokens) const {
    tokens.tokens = std::move(out.tokens);
    for (const OpenParts<Dim>& parts : out.open) {
      auto closing = prove_apart(parts, stop_);
      if (!closing) return false;
      tokens.places.push_back(parts.at);
      tokens.inserted.push_back({std::move(*closing), {}, {}});
    }
    return true;
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
            sum.cell_pairs,
            nullptr};
  }

  const VerifyOptions& options_;
  StopSignal stop_;
  std::optional<Hierarchy> hierarchy_;
  std::unique_ptr<MovingVertex<Dim>[]> vertices_;
  std::unique_ptr<StepCell<Dim>[]> cells_;  ///< in the order of the leaves
  std::optional<Leftovers> leftovers_;
  std::vector<Deferred> tasks_;
  std::vector<std::unique_ptr<TaskOutcome>> outcomes_;  ///< of the tasks that have begun
  std::optional<Reporter> reporter_;
  std::atomic<std::size_t> first_found_ = std::numeric_limits<std::size_t>::max();
  Earliest none_;
  TaskOutcome top_;  ///< of the walk over the top, then the sum of all
};

template <class Out>
VerifyResult verify(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
                    const VerifyOptions& options) {
  return options.dimension == 2 ? Verification<2, Out>(mesh, x_t0, x_t1, options).run()
                                : Verification<3, Out>(mesh, x_t0, x_t1, options).run();
}

}  // namespace

VerifyResult verify_step(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
                         const VerifyOptions& options) {
  if (mesh.cell_count() == 0) return {};
  return options.prove ? verify<Tokens>(mesh, x_t0, x_t1, options) : verify<NoTokens>(mesh, x_t0, x_t1, options);
}

}  // namespace noli
