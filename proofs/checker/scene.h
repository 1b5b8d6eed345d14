// SPDX-License-Identifier: Apache-2.0
//
// A claim about one step, in integers.
//
// Notation
//   leaf, node   of the tree over the cells; nodes are numbered in prefix order, the root is 0
//   vertices     ids after merging, each once; those of a leaf ascending
#pragma once

#include <span>

#include "trajectory.h"

namespace noli::checker {

using Vector = std::array<mpz_class, 3>;

/// A breakpoint: positions in units of 2^p, times of 2^q.
struct Breakpoint {
  mpz_class t;
  Vector x;
};
using Path = std::vector<Breakpoint>;

/// What the claims of all steps have in common.
struct Claim {
  int source = 0, dimension = 3;
  bool strict = false, points = false;
  std::uint32_t ring = 1, merged = 0;
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
  Integers(const Motion& motion, int p, int q, double eta, const Reader& c) : motion_(motion), p_(p), q_(q) {
    c.require(is_multiple(eta, p), "the least distance is no multiple of the step's unit");
    for (const double t : motion.times) c.require(is_multiple(t, q), "a time is no multiple of the step's unit");
    for (const auto& x : motion.x) {
      const bool whole = is_multiple(x[0], p) && is_multiple(x[1], p) && is_multiple(x[2], p);
      c.require(whole, "a position is no multiple of the step's unit");
    }
    eta_ = integer(eta, p);
    begin_ = integer(motion.t0, q);
    end_ = integer(motion.t1, q);
  }

  const Motion& motion() const { return motion_; }
  const mpz_class& eta() const { return eta_; }
  const mpz_class& begin() const { return begin_; }
  const mpz_class& end() const { return end_; }
  /// All breakpoints of a vertex.
  Path path(std::uint32_t v) const {
    Path result;
    for (std::uint64_t i = motion_.begin[v]; i < motion_.begin[v + 1]; ++i) {
      const auto& x = motion_.x[i];
      result.push_back({integer(motion_.times[i], q_), {integer(x[0], p_), integer(x[1], p_), integer(x[2], p_)}});
    }
    return result;
  }

 private:
  /// x = m 2^e, m an integer.
  static std::pair<long, int> parts(double x) {
    int e = 0;
    const auto m = static_cast<long>(std::ldexp(std::frexp(x, &e), 53));
    return {m, e - 53};
  }
  static bool is_multiple(double x, int p) {
    const auto [m, e] = parts(x);
    return m == 0 || std::countr_zero(static_cast<unsigned long>(m)) + e >= p;
  }
  static mpz_class integer(double x, int p) {
    const auto [m, e] = parts(x);
    mpz_class result(m);
    if (e >= p) result <<= static_cast<unsigned long>(e - p);
    if (e < p) result >>= static_cast<unsigned long>(p - e);
    return result;
  }

  const Motion& motion_;
  int p_, q_;
  mpz_class eta_, begin_, end_;
};

/// The tree of block TREE. An inner node keeps only those of its vertices that the child with more of them has not: a
/// vertex is kept again only where the number of vertices around it doubles, so memory does not grow with the depth of
/// the tree.
class Tree {
 public:
  struct Node {
    std::uint32_t left = 0, right = 0;  ///< of an inner node; a leaf has 0, 0
    std::uint32_t larger = 0;           ///< the child that has most of its vertices
    std::int64_t label = -1;            ///< that all cells below have, or -1
    std::uint32_t count = 0;            ///< of vertices that `larger` has not
    std::uint64_t first = 0;            ///< where they begin
    bool leaf() const { return left == 0; }
  };

  Tree(Reader c, const Claim& claim) : claim_(claim), seen_(claim.cells.size(), false) {
    add(c, 0);
    c.end();
    c.require(leaves_ == claim.cells.size(), "the tree has not all cells");
  }

  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  std::span<const std::uint32_t> own(std::uint32_t i) const {
    return {vertices_.data() + nodes_[i].first, nodes_[i].count};
  }
  /// Calls take(v) for each vertex of a node.
  template <class Take>
  void each(std::uint32_t i, const Take& take) const {
    for (;; i = nodes_[i].larger) {
      for (const std::uint32_t v : own(i)) take(v);
      if (nodes_[i].leaf()) return;
    }
  }

 private:
  using Vertices = std::vector<std::uint32_t>;

  /// The vertices of the node that is next, ascending.
  Vertices add(Reader& c, int depth) {
    const std::uint64_t code = c.uint();
    const std::size_t i = nodes_.size();
    nodes_.emplace_back();
    if (code != 0) {
      c.require(code <= claim_.cells.size() && !seen_[code - 1], "a cell that is not there, or is in the tree twice");
      seen_[code - 1] = true;
      ++leaves_;
      const std::set<std::uint32_t> vertices(claim_.cells[code - 1].begin(), claim_.cells[code - 1].end());
      nodes_[i].label = claim_.labels[code - 1];
      const Vertices own(vertices.begin(), vertices.end());
      keep(nodes_[i], own);
      return own;
    }
    c.require(depth < 255, "the tree is too deep");
    std::array<std::uint32_t, 2> child;
    std::array<Vertices, 2> has;
    for (std::size_t k = 0; k < 2; ++k) {
      child[k] = static_cast<std::uint32_t>(nodes_.size());
      has[k] = add(c, depth + 1);
    }
    const std::size_t most = has[0].size() < has[1].size() ? 1 : 0;
    Node& node = nodes_[i];
    node.left = child[0];
    node.right = child[1];
    node.larger = child[most];
    if (nodes_[child[0]].label == nodes_[child[1]].label) node.label = nodes_[child[0]].label;
    Vertices rest, all;
    std::ranges::set_difference(has[1 - most], has[most], std::back_inserter(rest));
    std::ranges::merge(has[most], rest, std::back_inserter(all));
    keep(node, rest);
    return all;
  }
  void keep(Node& node, const Vertices& own) {
    node.first = vertices_.size();
    node.count = static_cast<std::uint32_t>(own.size());
    vertices_.insert(vertices_.end(), own.begin(), own.end());
  }

  const Claim& claim_;
  std::vector<bool> seen_;
  std::size_t leaves_ = 0;
  std::vector<Node> nodes_;
  Vertices vertices_;
};

}  // namespace noli::checker
