// SPDX-License-Identifier: Apache-2.0
//
// The binary tree of groups over the cells of a moving mesh, with boxes at both ends of the step.
//
// Notation
//   node     a run of `count` entries of the leaf order; node i of count m > 1 has its left child, of count m / 2, at i
//            + 1 and its right child right after the left one's 2 (m / 2) - 1 nodes
//   box      least and greatest coordinate of the group, per axis, at t = 0 and at t = 1 (not the box swept in between)
//   phi      a map of coordinates to float, one for each axis and end: subtract the middle of the scene, scale by a
//            power of two, round. Every step is monotone, even rounding, so phi(a) > phi(b) implies a > b. So boxes are
//            floats, but an order found between them is exact
//
// If on one axis the boxes of two groups are in the same strict order at t = 0 and at t = 1, the axis is a separating
// direction for the whole step.
//
//   size     of a tree: the sum of the extents of all boxes, at both ends, over those of the root
//
// The tree is balanced by the number of cells. Along a chain of steps (proofs/prover/chain.h) it stays, and its boxes
// are fitted anew, until the size has grown by so much that the walk would lose more time than making it anew takes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <noli/mesh.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace noli {

/// phi, for one axis and one end of the step.
struct Phi {
  double middle = 0, scale = 1;

  /// A map that takes [low, high] approximately onto [-1, 1]; both bounds are finite.
  static Phi onto_unit(double low, double high);

  float operator()(double x) const { return static_cast<float>((x - middle) * scale); }
};

/// Four floats that are compared and combined lane by lane (an extension of g++ and clang++).
using Lanes = float __attribute__((vector_size(16)));

/// phi of the extreme coordinates of a group. Lanes: the axes, then unused (zero).
struct alignas(64) GroupBox {
  Lanes low_t0, low_t1, high_t0, high_t1;
};

inline Lanes least(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
inline Lanes greatest(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

inline GroupBox merged(const GroupBox& a, const GroupBox& b) {
  return {least(a.low_t0, b.low_t0), least(a.low_t1, b.low_t1), greatest(a.high_t0, b.high_t0),
          greatest(a.high_t1, b.high_t1)};
}

/// Whether a comparison holds in some lane.
template <class Comparison>
bool any_lane(const Comparison& lanes) {
#ifdef __SSE2__
  return _mm_movemask_epi8(std::bit_cast<__m128i>(lanes)) != 0;
#else
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(lanes);
  return (halves[0] | halves[1]) != 0;
#endif
}

/// Whether on some axis the boxes are in the same strict order at both ends.
inline bool axis_separates(const GroupBox& a, const GroupBox& b) {
  const auto over = (a.low_t0 > b.high_t0) & (a.low_t1 > b.high_t1);
  const auto under = (b.low_t0 > a.high_t0) & (b.low_t1 > a.high_t1);
  return any_lane(over | under);
}

/// The bits of the lanes in which a comparison holds.
template <class Comparison>
unsigned lanes_where(const Comparison& lanes) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(lanes)));
#else
  unsigned bits = 0;
  for (unsigned k = 0; k < 4; ++k) bits |= lanes[k] != 0 ? 1U << k : 0;
  return bits;
#endif
}

/// The axes that separate two boxes: bit k if a is the upper one, bit 4 + k if b is.
inline unsigned separating_axes(const GroupBox& a, const GroupBox& b) {
  const auto over = (a.low_t0 > b.high_t0) & (a.low_t1 > b.high_t1);
  const auto under = (b.low_t0 > a.high_t0) & (b.low_t1 > a.high_t1);
  return lanes_where(over) | lanes_where(under) << 4;
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

/// The first level below a root with enough groups for several threads. Calls at_level(groups) with each level above
/// it, from the root down, before it makes the next one.
template <class AtLevel>
std::vector<Group> top_groups(Group root, const AtLevel& at_level) {
  constexpr std::size_t enough = 64;
  std::vector<Group> level = {root};
  while (level.size() < enough && level.back().count >= 64) {
    at_level(level);
    std::vector<Group> next;
    for (const Group g : level) {
      next.push_back(g.left());
      next.push_back(g.right());
    }
    level = std::move(next);
  }
  return level;
}

class Hierarchy {
 public:
  /// Splits each group at the median of its cells' mid-time centres along its longest axis (ties by cell number), so
  /// the tree depends only on the input. O(n log n). Preconditions: as verify_step; at least one cell; dimension 2 or
  /// 3.
  Hierarchy(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension,
            int threads);

  /// Fits the boxes to the next step of the same mesh. True if the tree stayed; otherwise it was made anew. The result
  /// depends only on this tree and the input. O(n), or O(n log n) if it was made anew. Preconditions as above.
  bool refit(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension,
             int threads);

  Group root() const { return {0, 0, count_}; }
  const GroupBox& box_of(std::size_t node) const { return boxes_[node]; }
  /// The cells in the order of the leaves.
  std::span<const std::uint32_t> leaf_cells() const { return {leaf_cells_.get(), count_}; }

 private:
  class Fit;
  class Builder;

  void build(const Mesh& mesh, const Fit& fit, int dimension, int threads);
  /// Fits all boxes and returns the size: at_level(groups) with each level of the top, from the root down, then
  /// fit_group(g) for each group below it.
  template <class AtLevel, class FitGroup>
  double fit_groups(const Fit& fit, int threads, const AtLevel& at_level, const FitGroup& fit_group);

  std::uint32_t count_;
  double size_ = 0;  ///< when it was made
  // Not vectors, as one thread would first fill them with zeros.
  std::unique_ptr<std::uint32_t[]> leaf_cells_;
  std::unique_ptr<GroupBox[]> boxes_;
};

}  // namespace noli
