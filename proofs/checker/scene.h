// SPDX-License-Identifier: Apache-2.0
//
// A claim about one step, in integers.
//
// Notation
//   leaf, node   of the tree over the cells; nodes are numbered in prefix order, the root is 0
//   vertices     ids after merging, ascending, each once
#pragma once

#include <optional>
#include <span>

#include "numbers.h"
#include "trajectory.h"

namespace noli::checker {

/// A breakpoint: positions in units of 2^p, times of 2^q.
struct Breakpoint {
  mpz_class t;
  std::array<mpz_class, 3> x;
};
using Path = std::vector<Breakpoint>;

/// What the claims of all steps have in common.
struct Claim {
  int source = 0;
  bool strict = false;
  std::uint32_t ring = 1;
  double eta = 0;
  std::vector<std::uint32_t> same;  ///< by vertex: the one that stands for it
  std::vector<Cell> cells;          ///< after merging
  std::vector<std::uint32_t> labels;
  std::set<LabelPair> excluded;

  bool is_excluded(std::uint32_t a, std::uint32_t b) const {
    return excluded.count({std::min(a, b), std::max(a, b)}) != 0;
  }
};

/// The motion of a step in integers, made when somebody asks.
class Integers {
 public:
  Integers(const Motion& motion, int p, int q, double eta, const Cursor& c) : motion_(motion), p_(p), q_(q) {
    bool whole = is_multiple(eta, p) && is_multiple(motion.t0, q) && is_multiple(motion.t1, q);
    for (const double t : motion.times) whole = whole && is_multiple(t, q);
    for (const auto& x : motion.x)
      whole = whole && is_multiple(x[0], p) && is_multiple(x[1], p) && is_multiple(x[2], p);
    if (!whole) c.fail("a number of the motion is no multiple of the step's unit");
    eta_ = integer(eta, p);
    begin_ = integer(motion.t0, q);
    end_ = integer(motion.t1, q);
  }

  const Motion& motion() const { return motion_; }
  const mpz_class& eta() const { return eta_; }
  const mpz_class& begin() const { return begin_; }
  const mpz_class& end() const { return end_; }
  Breakpoint at(std::uint64_t i) const {
    const auto& x = motion_.x[i];
    return {integer(motion_.times[i], q_), {integer(x[0], p_), integer(x[1], p_), integer(x[2], p_)}};
  }
  /// All breakpoints of a vertex.
  Path path(std::uint32_t v) const {
    Path result;
    for (std::uint64_t i = motion_.begin[v]; i < motion_.begin[v + 1]; ++i) result.push_back(at(i));
    return result;
  }

 private:
  const Motion& motion_;
  int p_, q_;
  mpz_class eta_, begin_, end_;
};

/// The tree of block TREE.
class Tree {
 public:
  struct Node {
    std::uint32_t left = 0, right = 0;  ///< of an inner node; a leaf has 0, 0
    std::int64_t label = -1;            ///< that all cells below have, or -1
    std::uint64_t first = 0;            ///< its vertices are so many from here
    std::uint32_t count = 0, cell = 0;
    bool leaf() const { return left == 0; }
  };

  Tree(Cursor c, const Claim& claim) : claim_(claim) {
    seen_.assign(claim.cells.size(), false);
    add(c, 0);
    c.end();
    if (leaves_ != claim.cells.size()) c.fail("the tree has not all cells");
  }

  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  std::span<const std::uint32_t> vertices(std::uint32_t i) const {
    return {vertices_.data() + nodes_[i].first, nodes_[i].count};
  }

 private:
  std::uint32_t add(Cursor& c, int depth) {
    const std::uint64_t code = c.uint();
    const auto i = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    if (code == 0) {
      if (depth == 255) c.fail("the tree is too deep");
      const std::uint32_t left = add(c, depth + 1), right = add(c, depth + 1);
      join(i, left, right);
    } else {
      if (code > claim_.cells.size() || seen_[code - 1]) c.fail("a cell that is not there, or is in the tree twice");
      seen_[code - 1] = true;
      ++leaves_;
      leaf(i, static_cast<std::uint32_t>(code - 1));
    }
    return i;
  }
  void leaf(std::uint32_t i, std::uint32_t cell) {
    Cell v = claim_.cells[cell];
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
    nodes_[i].label = claim_.labels[cell];
    nodes_[i].cell = cell;
    put(i, v);
  }
  void join(std::uint32_t i, std::uint32_t left, std::uint32_t right) {
    Cell both;
    std::ranges::set_union(vertices(left), vertices(right), std::back_inserter(both));
    nodes_[i].left = left;
    nodes_[i].right = right;
    if (nodes_[left].label == nodes_[right].label) nodes_[i].label = nodes_[left].label;
    put(i, both);
  }
  void put(std::uint32_t i, const Cell& v) {
    nodes_[i].first = vertices_.size();
    nodes_[i].count = static_cast<std::uint32_t>(v.size());
    vertices_.insert(vertices_.end(), v.begin(), v.end());
  }

  const Claim& claim_;
  std::vector<bool> seen_;
  std::size_t leaves_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace noli::checker
