// SPDX-License-Identifier: Apache-2.0
//
// Where a step aims if what contact moves takes its surroundings with it: by how much each vertex was off where it was
// given, averaged over its neighbourhood and a little less, is added to where it is given next.
//
// Without this, every step presses what lies on a body into it as deep as it was given, and lets its surroundings go
// where they were given: contact holds, but a cloth is torn to spikes over many steps.
//
// Notation
//   d_v     how far vertex v was off at the beginning of the step: x_v - y_v
//   round   d_v becomes the mean of itself and of the mean of its neighbours; fixed vertices keep 0. n^2 rounds spread
//           a displacement over about n edges, as heat spreads
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <noli/mesh.h>

namespace noli {

class CarriedDisplacement {
 public:
  /// `spread`: n, in edges. `fixed`: by vertex, nonzero if it moves as given. O(size of the mesh).
  CarriedDisplacement(const Mesh& mesh, std::span<const std::uint8_t> fixed, std::uint64_t spread);

  /// What is added to each vertex. x, y: repaired and given positions at the beginning of the step. Exactly 0 where no
  /// vertex within n^2 edges was off. O(n^2 size of the mesh); the same bits everywhere.
  std::vector<Position> operator()(std::span<const Position> x, std::span<const Position> y) const;

 private:
  static constexpr double kept = 0.9;  ///< of a displacement in each step, so that it goes back where there is room

  std::uint64_t rounds_;
  std::span<const std::uint8_t> fixed_;
  std::vector<std::size_t> first_;  ///< of each vertex's neighbours in neighbours_; one more at the end
  std::vector<VertexId> neighbours_;
};

}  // namespace noli
