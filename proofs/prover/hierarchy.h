// SPDX-License-Identifier: Apache-2.0
//
// The binary tree of groups over the cells of a moving mesh, with boxes at both ends of the step.
//
// Notation
//   node     a run of `count` entries of the leaf order; node i of count m > 1 has its left child, of count m / 2, at i
//   + 1
//            and its right child right after the left one's 2 (m / 2) - 1 nodes
//   box      least and greatest coordinate of the group, per axis, at t = 0 and at t = 1 (not the box swept in between)
//   phi      a map of coordinates to float, one for each axis and end: subtract the middle of the scene, scale by a
//   power of two,
//            round. Every step is monotone (rounding is), so phi(a) > phi(b) implies a > b: boxes are kept as floats
//            and yet an order found between them is exact
//
// If on one axis the boxes of two groups are in the same strict order at t = 0 and at t = 1, the axis is a separating
// direction for the whole step.
//
// What this does not do: it balances by number, not by cost; it is not updated when the mesh moves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "noli/trajectory/mesh.h"

namespace noli {

/// phi of the extreme coordinates of a group. Lanes: the axes, then unused (zero).
struct alignas(64) GroupBox {
  std::array<float, 4> low_t0, low_t1, high_t0, high_t1;
};

/// The lanes in which a is above b at both ends, as a bit mask.
inline unsigned above(const GroupBox& a, const GroupBox& b) {
  unsigned mask = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool yes = (a.low_t0[k] > b.high_t0[k]) & (a.low_t1[k] > b.high_t1[k]);
    mask |= static_cast<unsigned>(yes) << k;
  }
  return mask;
}

/// A node and the number of leaves below it.
struct Group {
  std::uint32_t node = 0;
  std::uint32_t begin = 0;  ///< place of its first leaf in the leaf order
  std::uint32_t count = 0;

  bool is_leaf() const { return count == 1; }
  Group left() const { return {node + 1, begin, count / 2}; }
  Group right() const { return {node + 2 * (count / 2), begin + count / 2, count - count / 2}; }
};

class Hierarchy {
 public:
  /// Splits each group at the median of its cells' mid-time centres along its longest axis (ties by cell number), so
  /// the tree depends on nothing but the input. O(n log n). Preconditions: as verify_step; at least one cell; dimension
  /// 2 or 3.
  Hierarchy(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension,
            int threads);

  Group root() const { return {0, 0, static_cast<std::uint32_t>(leaf_cells_.size())}; }
  const GroupBox& box(Group g) const { return boxes_[g.node]; }
  /// The cells in the order of the leaves.
  std::span<const std::uint32_t> leaf_cells() const { return leaf_cells_; }

 private:
  std::vector<std::uint32_t> leaf_cells_;
  std::vector<GroupBox> boxes_;
};

}  // namespace noli
