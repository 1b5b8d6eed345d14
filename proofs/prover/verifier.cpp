// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/verifier.h"

#include <algorithm>
#include <memory>

#include "proofs/prover/early_tokens.h"
#include "proofs/prover/task_walk.h"

namespace noli {

namespace {

/// The cells of a mesh in the order of a tree's leaves, and the vertices that they refer to.
template <int Dim>
class Prepared : public ChainMemory {
 public:
  Prepared(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
           const VerifyOptions& options)
      : vertices_(std::make_unique_for_overwrite<MovingVertex<Dim>[]>(mesh.vertex_count)),
        cells_(std::make_unique_for_overwrite<StepCell<Dim>[]>(mesh.cell_count())) {
    parallel_both(
        options.threads, [&] { hierarchy_.emplace(mesh, x_t0, x_t1, Dim, options.threads); },
        [&] { features_ = find_owners(mesh, options.strict); });
    gather_vertices(x_t0, x_t1, options.threads);
    gather_cells(mesh, options.threads);
  }

  /// Goes on to the next step of the same mesh.
  void next(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int threads) {
    const bool same_tree = hierarchy_->refit(mesh, x_t0, x_t1, Dim, threads);
    gather_vertices(x_t0, x_t1, threads);
    if (!same_tree) gather_cells(mesh, threads);
  }

  const Hierarchy& hierarchy() const { return *hierarchy_; }
  const StepCell<Dim>* cells() const { return cells_.get(); }
  const Leftovers& leftovers() const { return *leftovers_; }

 private:
  void gather_vertices(std::span<const Position> x_t0, std::span<const Position> x_t1, int threads) {
    for_each_in_pieces(x_t0.size(), threads,
                       [&](std::size_t v) { vertices_[v] = moving_vertex<Dim>(x_t0[v], x_t1[v]); });
  }

  void gather_cells(const Mesh& mesh, int threads) {
    const auto order = hierarchy_->leaf_cells();
    for_each_in_pieces(order.size(), threads, [&](std::size_t i) {
      cells_[i] = {indices_of(mesh, features_, order[i]), vertices_.get()};
    });
    leftovers_.emplace(order.size(), [this](std::size_t i) {
      return Leftovers::NumberedShape{shape_of(cells_[i]), cells_[i].cell};
    });
  }

  std::optional<Hierarchy> hierarchy_;
  CellFeatures features_;
  std::unique_ptr<MovingVertex<Dim>[]> vertices_;
  std::unique_ptr<StepCell<Dim>[]> cells_;
  std::optional<Leftovers> leftovers_;
};

/// One verification of one step. `Out`: Tokens, or NoTokens.
template <int Dim, class Out>
class Verification {
 public:
  Verification(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
               const VerifyOptions& options)
      : options_(options), stop_(options), none_(options.max_reports, {ExactlyInStep{x_t0, x_t1, Dim}, 1}) {
    // If memory runs out, the chain begins anew: what is half made must not be used again.
    if (options.chain != nullptr) memory_ = std::move(*options.chain);
    prepared_ = dynamic_cast<Prepared<Dim>*>(memory_.get());
    if (prepared_ != nullptr) {
      // The parts of a step have the same positions, so what another part left fits as it is.
      if (options.part.of == 1) prepared_->next(mesh, x_t0, x_t1, options.threads);
      return;
    }
    auto made = std::make_unique<Prepared<Dim>>(mesh, x_t0, x_t1, options);
    prepared_ = made.get();
    memory_ = std::move(made);
  }

  VerifyResult run() {
    const Straight<Dim> positions(prepared_->hierarchy(), prepared_->cells(), prepared_->leftovers());
    Walk walk(positions, options_, stop_, none_);
    const Group root = prepared_->hierarchy().root();
    walk.cut(root.count, [&](auto& top) { return top.run({root, root}); });
    walk.keep(options_.part);
    const std::size_t first_kept = settle(walk);
    auto& sum = walk.sum();
    VerifyResult result{sum.tally.findings(sum.finished), std::nullopt, nullptr};
    if (const auto first = sum.tally.earliest.first()) result.first = first->contact;
    if constexpr (Out::on) {
      if (result.complete && !sum.tally.something_meets()) {
        result.proof = prove(walk, first_kept);
        result.complete = result.proof != nullptr || !stop_.raised();
        if (result.proof && options_.receiver != nullptr) pass_on(result);
      }
    }
    if (options_.chain != nullptr) *options_.chain = std::move(memory_);
    return result;
  }

 private:
  using Walk = TaskWalk<Straight<Dim>, Out>;

  /// Settles the tasks, and returns the first whose tokens were not passed on.
  std::size_t settle(Walk& walk) const {
    Progress progress(options_);
    progress.begin(0, 1, walk.task_count());
    if constexpr (Out::on) {
      if (options_.receiver != nullptr) {
        EarlyTokens early(walk, prepared_->hierarchy().leaf_cells(), *options_.receiver);
        walk.run([&](std::size_t task) {
          progress.task_done();
          early.task_done(task);
        });
        return early.next();
      }
    }
    walk.run([&](std::size_t /*task*/) { progress.task_done(); });
    return walk.first_task();
  }

  /// Passes the rest of the proof on.
  void pass_on(VerifyResult& result) const {
    result.proof->tokens.give([this](std::string_view bytes) { options_.receiver->tokens(bytes); });
    result.proof.reset();
    result.receiver_has_proof = true;
  }

  /// Joins the tokens from task `first` on. Nothing if no direction separates some of the remaining parts, or it was
  /// stopped.
  std::shared_ptr<const StepProof> prove(Walk& walk, std::size_t first) const {
    auto proof = std::make_shared<StepProof>();
    const auto order = prepared_->hierarchy().leaf_cells();
    const auto& [index, of] = options_.part;
    // A receiver has the tree.
    if (index == 0 && options_.receiver == nullptr) proof->leaf_cells.assign(order.begin(), order.end());
    const auto& tasks = walk.tasks();
    const std::size_t end = walk.first_task() + walk.task_count(), count = end - first;
    JoinedTokens& all = proof->tokens;
    all.tokens = std::move(walk.sum().out.tokens);
    all.begin = first == 0 ? 0 : tasks[first - 1].tokens_before;
    if (index + 1 < of) all.end = end == 0 ? 0 : tasks[end - 1].tokens_before;
    for (std::size_t i = first; i < end; ++i) all.places.push_back(tasks[i].tokens_before);
    all.inserted.resize(count);
    std::atomic<bool> whole = true;
    parallel_for(count, options_.threads, [&](std::size_t i) {
      if (whole && !close_open_parts(walk.outcome(first + i).out, all.inserted[i])) whole = false;
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

  const VerifyOptions& options_;
  StopSignal stop_;
  std::unique_ptr<ChainMemory> memory_;
  Prepared<Dim>* prepared_ = nullptr;
  Tally none_;
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
