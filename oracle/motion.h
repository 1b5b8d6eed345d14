// SPDX-License-Identifier: Apache-2.0
//
// Defines the oracle's input: two features of at most four points that move linearly over one step.
#pragma once

#include <array>
#include <cstddef>

namespace noli::oracle {

enum class Pair { vertex_face, edge_edge, vertex_edge, vertex_vertex };

using Coordinates = std::array<double, 3>;

/// Points: v | f0 f1 f2, a0 a1 | b0 b1, v | e0 e1, v | w; the rest is ignored. In 2D, the third coordinate is ignored
/// too, and the pairs are vertex_edge and vertex_vertex. Coordinates are finite.
struct Motion {
  Pair pair = Pair::vertex_face;
  int dimension = 3;
  std::array<Coordinates, 4> x_t0{};
  std::array<Coordinates, 4> x_t1{};
};

constexpr std::size_t point_count(Pair pair) {
  return pair == Pair::vertex_vertex ? 2 : pair == Pair::vertex_edge ? 3 : 4;
}

/// The number of points of the first feature.
constexpr std::size_t first_count(Pair pair) { return pair == Pair::edge_edge ? 2 : 1; }

}  // namespace noli::oracle
