// SPDX-License-Identifier: Apache-2.0
//
// The recursion over pairs of groups that writes the tokens of one span of a step.
//
// Notation
//   box      of a node: least and greatest coordinates of its vertices' chords at both ends of the span, with their
//            radii. If on one axis the boxes of two nodes are in the same strict order at both ends, the axis is a
//            direction that separates them throughout
//   grain    as in proofs/prover/traversal.h
//
// What this does not do: no threads.
#pragma once

#include <atomic>
#include <set>

#include "proofs/prover/tokens/proof_parts.h"
#include "proofs/prover/traversal.h"

namespace noli {

template <int Dim>
struct ProofBox {
  /// low[end][axis], high[end][axis]
  std::array<std::array<double, Dim>, 2> low, high;
};

/// Unordered pairs of labels, the smaller first.
using LabelPairs = std::set<std::array<std::uint32_t, 2>>;

template <int Dim>
struct ProofScene {
  const WorldLines& lines;
  const ProofTree& tree;
  const LabelPairs& excluded;
  bool strict;
  double eta;
  const MeshPaths& paths;
  std::vector<ProofChord<Dim>> chords;  ///< by vertex
  std::vector<ProofBox<Dim>> boxes;     ///< by node
  Piece span;
};

/// A pair of nodes, or a node with itself.
struct ProofTask {
  std::uint32_t x, y;
  bool self;
};

template <int Dim>
class ProofWalk {
 public:
  ProofWalk(const ProofScene<Dim>& scene, const StopSignal& stop)
      : scene_(scene), stop_(stop), parts_(scene.lines, scene.chords, scene.span, scene.eta, &scene.paths, stop) {}

  /// Writes the tokens of an obligation. What is about at most `grain` cells is put on `tasks` instead, if there is
  /// such a list: then `cut` is called where its tokens have to be put. False if it was stopped.
  template <class Cut>
  bool run(const ProofTask& task, Tokens& tokens, std::uint32_t grain, std::vector<ProofTask>* tasks, const Cut& cut) {
    grain_ = grain;
    tasks_ = tasks;
    tokens_ = &tokens;
    cut_ = [&] { tokens_ = &cut(); };
    task.self ? self(task.x) : pair(task.x, task.y);
    return !stopped_;
  }

 private:
  static constexpr unsigned patience = 256;

  const ProofTree::Node& node(std::uint32_t i) const { return scene_.tree.node(i); }

  bool put_off(const ProofTask& task) {
    const std::uint32_t size = node(task.x).count + (task.self ? 0 : node(task.y).count);
    if (tasks_ == nullptr || size > grain_) return false;
    tasks_->push_back(task);
    cut_();
    return true;
  }

  bool excluded(std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t a = node(x).label, b = node(y).label;
    return a != ProofTree::no_label && b != ProofTree::no_label && !scene_.excluded.empty() &&
           scene_.excluded.count({std::min(a, b), std::max(a, b)}) != 0;
  }

  void self(std::uint32_t x) {
    if (stopped_ || put_off({x, x, true})) return;
    if (excluded(x, x)) return tokens_->excluded();
    if (!node(x).leaf()) {
      tokens_->parts();
      self(node(x).left);
      pair(node(x).left, node(x).right);
      self(node(x).right);
    } else if (scene_.strict) {
      tokens_->both();
      cells(x, x);
    } else {
      tokens_->one();
    }
  }

  void pair(std::uint32_t x, std::uint32_t y) {
    if (stopped_) return;
    const ProofBox<Dim>&a = scene_.boxes[x], &b = scene_.boxes[y];
    for (std::size_t k = 0; k < Dim; ++k) {
      if (over(a.low[0][k], b.high[0][k]) && over(a.low[1][k], b.high[1][k])) return tokens_->axis(k, true);
      if (over(b.low[0][k], a.high[0][k]) && over(b.low[1][k], a.high[1][k])) return tokens_->axis(k, false);
    }
    take_apart(x, y);
  }

  /// Whether x is above y by more than the least distance. Where the difference is rounded it is by less than the two
  /// together, which is left out of it.
  bool over(double x, double y) const {
    return scene_.eta == 0 ? x > y : x - y > scene_.eta + 0x1p-51 * (std::abs(x) + std::abs(y) + scene_.eta);
  }

  void take_apart(std::uint32_t x, std::uint32_t y) {
    if (put_off({x, y, false})) return;
    if (excluded(x, y)) return tokens_->excluded();
    if (++since_look_ >= patience) look_at_clock();
    const ProofTree::Node &a = node(x), &b = node(y);
    if (a.leaf() && b.leaf()) {
      cells(x, y);
    } else if (a.count >= b.count) {
      tokens_->left();
      pair(a.left, y);
      pair(a.right, y);
    } else {
      tokens_->right();
      pair(x, b.left);
      pair(x, b.right);
    }
  }

  void cells(std::uint32_t x, std::uint32_t y) {
    const std::uint32_t i = node(x).cell, j = node(y).cell;
    parts_.settle(i, scene_.tree.cell(i), j, scene_.tree.cell(j), *tokens_);
    stopped_ = stopped_ || parts_.stopped();
  }

  void look_at_clock() {
    since_look_ = 0;
    if (stop_.raised()) stopped_ = true;
  }

  const ProofScene<Dim>& scene_;
  const StopSignal& stop_;
  ProofParts<Dim> parts_;
  Tokens* tokens_ = nullptr;
  std::uint32_t grain_ = 0;
  std::vector<ProofTask>* tasks_ = nullptr;
  std::function<void()> cut_;
  unsigned since_look_ = 0;
  bool stopped_ = false;
};

}  // namespace noli
