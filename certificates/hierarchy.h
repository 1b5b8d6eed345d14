// SPDX-License-Identifier: Apache-2.0
//
// A kinetic hierarchy: boxes that move linearly over a time interval, in a binary tree over the cells.
//
// Notation
//   interval  [begin, end] of time
//   box       low(t), high(t), linear between their values at begin and end. It contains its contents at every t in
//             between, since these move linearly too
// Two boxes are apart over the whole interval if along one axis one is below the other at begin and at end.
//
// The tree is built once, by medians, from the first positions of cells; boxes are refitted. Cells that move together
// usually stay together; otherwise boxes overlap more, but the answers are the same.
//
// Distances are up to the caller: add the distance to be kept clear to the boxes of the leaves.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "certificates/vector.h"
#include "trajectory/stop.h"

namespace noli::certificates {

template <int Dim>
struct MovingBox {
  std::array<Vector<Dim>, 2> low, high;  ///< at begin and end

  static MovingBox empty() {
    MovingBox box;
    box.low.fill(Vector<Dim>::Constant(std::numeric_limits<double>::infinity()));
    box.high.fill(Vector<Dim>::Constant(-std::numeric_limits<double>::infinity()));
    return box;
  }

  void add(const MovingBox& other) {
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = low[k].cwiseMin(other.low[k]);
      high[k] = high[k].cwiseMax(other.high[k]);
    }
  }

  bool apart(const MovingBox& other) const {
    for (int d = 0; d < Dim; ++d) {
      if (low[0][d] > other.high[0][d] && low[1][d] > other.high[1][d]) return true;
      if (other.low[0][d] > high[0][d] && other.low[1][d] > high[1][d]) return true;
    }
    return false;
  }
};

template <int Dim>
class Hierarchy {
 public:
  using Box = MovingBox<Dim>;

  /// Builds the tree over cells with these centres. Pairs of cells that are both `fixed`, that is never move, are left
  /// out. Throws Stopped, like refit() and for_each_pair().
  explicit Hierarchy(std::span<const Vector<Dim>> centres = {}, const std::vector<bool>& fixed = {}) {
    if (centres.empty()) return;
    order_.resize(centres.size());
    std::iota(order_.begin(), order_.end(), 0U);
    place_.resize(centres.size());
    boxes_.resize(2 * centres.size() - 1);
    nodes_.resize(boxes_.size());
    build(0, 0, static_cast<std::uint32_t>(centres.size()), none, centres);
    for (std::size_t n = nodes_.size(); n-- > 0;) {
      end_if_stopped();
      nodes_[n].fixed =
          is_leaf(n) ? fixed[order_[nodes_[n].begin]] : nodes_[left(n)].fixed && nodes_[nodes_[n].right].fixed;
    }
  }

  /// Refits all boxes; box_of(cell) gives those of the leaves.
  template <class BoxOf>
  void refit(const BoxOf& box_of) {
    for (std::size_t n = nodes_.size(); n-- > 0;) {
      end_if_stopped();
      if (is_leaf(n)) {
        boxes_[n] = box_of(order_[nodes_[n].begin]);
      } else {
        boxes_[n] = boxes_[left(n)];
        boxes_[n].add(boxes_[nodes_[n].right]);
      }
    }
  }

  /// Enlarges the box of a cell and all boxes around it.
  void enlarge(std::uint32_t cell, const Box& box) {
    for (std::uint32_t n = place_[cell]; n != none; n = nodes_[n].parent) boxes_[n].add(box);
  }

  /// Calls each(a, b) for all pairs of different cells whose boxes are not apart, once.
  template <class Each>
  void for_each_pair(Each&& each) const {
    if (!nodes_.empty()) within(0, each);
  }

  /// Calls each(cell) for all cells whose boxes are not apart from this one.
  template <class Each>
  void for_each_near(const Box& box, Each&& each) const {
    if (!nodes_.empty()) near(0, box, each);
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Cells order_[begin, end); a node's left child is the next node.
  struct Node {
    std::uint32_t begin, end, right, parent;
    bool fixed;  ///< all its cells are
  };

  bool is_leaf(std::size_t n) const { return nodes_[n].end - nodes_[n].begin == 1; }
  static std::size_t left(std::size_t n) { return n + 1; }

  std::uint32_t build(std::uint32_t node, std::uint32_t begin, std::uint32_t end, std::uint32_t parent,
                      std::span<const Vector<Dim>> centres) {
    end_if_stopped();
    nodes_[node] = {begin, end, none, parent, false};
    if (end - begin == 1) {
      place_[order_[begin]] = node;
      return node + 1;
    }
    const std::uint32_t middle = begin + (end - begin) / 2;
    const int axis = longest_axis(begin, end, centres);
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
                     });
    const std::uint32_t right = build(node + 1, begin, middle, node, centres);
    nodes_[node].right = right;
    return build(right, middle, end, node, centres);
  }

  int longest_axis(std::uint32_t begin, std::uint32_t end, std::span<const Vector<Dim>> centres) const {
    Vector<Dim> low = centres[order_[begin]], high = low;
    for (std::uint32_t i = begin; i < end; ++i) {
      low = low.cwiseMin(centres[order_[i]]);
      high = high.cwiseMax(centres[order_[i]]);
    }
    int axis = 0;
    for (int d = 1; d < Dim; ++d) {
      if (high[d] - low[d] > high[axis] - low[axis]) axis = d;
    }
    return axis;
  }

  template <class Each>
  void within(std::size_t n, Each&& each) const {
    if (is_leaf(n) || nodes_[n].fixed) return;
    within(left(n), each);
    within(nodes_[n].right, each);
    between(left(n), nodes_[n].right, each);
  }

  template <class Each>
  void between(std::size_t a, std::size_t b, Each&& each) const {
    if (boxes_[a].apart(boxes_[b]) || (nodes_[a].fixed && nodes_[b].fixed)) return;
    end_if_stopped();
    if (is_leaf(a) && is_leaf(b)) return each(order_[nodes_[a].begin], order_[nodes_[b].begin]);
    if (nodes_[a].end - nodes_[a].begin >= nodes_[b].end - nodes_[b].begin) {
      between(left(a), b, each);
      between(nodes_[a].right, b, each);
    } else {
      between(a, left(b), each);
      between(a, nodes_[b].right, each);
    }
  }

  template <class Each>
  void near(std::size_t n, const Box& box, Each&& each) const {
    if (boxes_[n].apart(box)) return;
    if (is_leaf(n)) return each(order_[nodes_[n].begin]);
    near(left(n), box, each);
    near(nodes_[n].right, box, each);
  }

  std::vector<std::uint32_t> order_;  ///< cells
  std::vector<std::uint32_t> place_;  ///< by cell: its leaf
  std::vector<Node> nodes_;           ///< in depth-first order
  std::vector<Box> boxes_;
};

}  // namespace noli::certificates
