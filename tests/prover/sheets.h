// SPDX-License-Identifier: Apache-2.0
//
// Builds surfaces for the tests of sheets.
#pragma once

#include "scenes.h"
#include "trajectory/world_lines.h"

namespace noli::testing {

struct Surface {
  Mesh mesh;
  std::vector<Position> x;
};

/// n by m unit squares in the plane z = 0, each split in two; vertex (i, j) has the number i (m + 1) + j.
Surface grid(std::uint32_t n, std::uint32_t m);
/// The surface of the cube [0, n]^3, in unit squares.
Surface closed_box(std::uint32_t n);
/// n squares around a hole, in the plane.
Surface ring_of_squares(std::uint32_t n);

/// Adds another surface, moved by `by`.
void append(Surface& surface, const Surface& other, const Position& by);
/// Applies shears along the axes that together resemble a rotation; straight lines become nearly straight.
void turn(Surface& surface, double a, double b, double c);

}  // namespace noli::testing
