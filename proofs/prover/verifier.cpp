// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/verifier.h"

#include <algorithm>
#include <memory>

#include "proofs/prover/task_walk.h"

namespace noli {

namespace {

/// One verification of one step. `Out`: Tokens, or NoTokens.
template <int Dim, class Out>
class Verification {
 public:
  Verification(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
               const VerifyOptions& options)
      : options_(options), stop_(options), none_(options.max_reports, {ExactlyInStep{x_t0, x_t1, Dim}, 1}) {
    CellFeatures features;
    parallel_both(
        options.threads, [&] { hierarchy_.emplace(mesh, x_t0, x_t1, Dim, options.threads); },
        [&] { features = find_owners(mesh, options.strict); });
    gather_vertices(x_t0, x_t1);
    gather_cells(mesh, features);
  }

  VerifyResult run() {
    const Straight<Dim> positions(*hierarchy_, cells_.get(), *leftovers_);
    TaskWalk<Straight<Dim>, Out> walk(positions, options_, stop_, none_);
    Progress progress(options_);
    const Group root = hierarchy_->root();
    walk.cut(root.count, [&](auto& top) { return top.run({root, root}); });
    progress.begin(0, 1, walk.tasks().size());
    walk.run([&](std::size_t /*task*/) { progress.task_done(); });
    auto& sum = walk.sum();
    VerifyResult result{sum.tally.findings(sum.finished), std::nullopt, nullptr};
    if (const auto first = sum.tally.earliest.first()) result.first = first->contact;
    if constexpr (Out::on) {
      if (result.complete && !result.touches()) {
        result.proof = prove(walk);
        result.complete = result.proof != nullptr || !stop_.raised();
      }
    }
    return result;
  }

 private:
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

  /// Joins the tokens of the tasks. Nothing if no direction separates some of the remaining parts, or it was stopped.
  std::shared_ptr<const StepProof> prove(TaskWalk<Straight<Dim>, Out>& walk) const {
    auto proof = std::make_shared<StepProof>();
    const auto order = hierarchy_->leaf_cells();
    proof->leaf_cells.assign(order.begin(), order.end());
    JoinedTokens& all = proof->tokens;
    all.tokens = std::move(walk.sum().out.tokens);
    for (const Deferred& task : walk.tasks()) all.places.push_back(task.tokens_before);
    all.inserted.resize(walk.tasks().size());
    std::atomic<bool> whole = true;
    parallel_for(walk.tasks().size(), options_.threads, [&](std::size_t i) {
      if (whole && !close_open_parts(walk.outcome(i).out, all.inserted[i])) whole = false;
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
  std::optional<Hierarchy> hierarchy_;
  std::unique_ptr<MovingVertex<Dim>[]> vertices_;
  std::unique_ptr<StepCell<Dim>[]> cells_;  ///< in the order of the leaves
  std::optional<Leftovers> leftovers_;
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
