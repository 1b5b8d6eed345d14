// SPDX-License-Identifier: Apache-2.0
//
// Builds moving meshes for the tests of the verifier, by hand or from a generator with fixed numbers.
#pragma once

#include <cstdint>
#include <vector>

#include <noli/mesh.h>

namespace noli::testing {

/// A mesh over one step.
struct Step {
  Mesh mesh;
  std::vector<Position> x_t0, x_t1;

  /// Adds a vertex that moves between two positions; returns its id.
  VertexId vertex(const Position& at_t0, const Position& at_t1);
  /// Adds a vertex that rests.
  VertexId vertex(const Position& x) { return vertex(x, x); }
  /// Adds a face with three vertices of its own, moved by `motion`.
  void face(const Position& a, const Position& b, const Position& c, const Position& motion = {});
};

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// 0 <= result < n.
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(next() % n); }
  /// A multiple of 2^-20 in [-1, 1).
  double unit() { return static_cast<double>(static_cast<std::int64_t>(next() >> 43)) * 0x1p-20 - 1; }

 private:
  std::uint64_t state_;
};

/// The size of a random soup.
struct SoupSize {
  std::uint32_t vertices, faces, edges, points;
  std::uint32_t span;  ///< coordinates are integers in [-span, span]; a small span produces every degeneracy
};

/// Cells whose corners are random vertices, perhaps repeated; in 2D the third coordinate is noise.
Step random_soup(std::uint64_t seed, const SoupSize& size, int dimension);

/// Two rough sheets of n by n squares, a step apart, the upper one moved down by `fall` squares.
Step two_sheets(std::uint64_t seed, std::uint32_t n, double fall);

}  // namespace noli::testing
