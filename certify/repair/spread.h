// SPDX-License-Identifier: Apache-2.0
//
// Where a step aims if what contact moves takes its surroundings along (--spread): by how much each vertex was off
// where it was given, averaged over its surroundings and a little less, is added to where it is given next.
//
// Without this, every step presses what lies on a body into it as deep as it was given, and lets its surroundings go
// where they were given: contact holds, but over many steps a cloth is torn to spikes.
//
// Notation
//   d_v     how far vertex v was off at the beginning of the step: x_v - y_v
//   round   d_v becomes the mean of itself and of the mean of its neighbours; fixed vertices keep 0. n^2 rounds spread
//           a displacement over about n edges, as heat spreads
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <noli/mesh.h>

namespace noli {

class SpreadDisplacement {
 public:
  /// `spread`: n, in edges. `fixed`: by vertex, nonzero if it moves as given; has to outlive this. O(size of the mesh).
  SpreadDisplacement(const Mesh& mesh, std::span<const std::uint8_t> fixed, std::uint64_t spread);

  /// What is added to each vertex. x, y: repaired and given positions at the beginning of the step. Exactly 0 where it
  /// would be less than a thousandth of the largest, and so beyond some 2 n edges. O(n^2 size of the mesh), without use
  /// once `stop` has returned true; the same bits everywhere.
  std::vector<Position> operator()(std::span<const Position> x, std::span<const Position> y,
                                   const std::function<bool()>& stop) const;

 private:
  void spread_once(const std::vector<Position>& d, std::vector<Position>& next) const;

  std::uint64_t rounds_;
  std::span<const std::uint8_t> fixed_;
  std::vector<std::size_t> first_;  ///< of each vertex's neighbours in neighbours_; one more at the end
  std::vector<VertexId> neighbours_;
};

}  // namespace noli
