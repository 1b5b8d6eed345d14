// SPDX-License-Identifier: Apache-2.0
//
// A cell whose corners go along world lines: their chords over a while, and how far they stray.
//
// Notation
//   radius   per axis, the greatest of the radii of the corners' chords (proofs/prover/chord.h)
//   margin   the greatest radius of two cells, added, over the axes. If n.(a - b) > margin |n|_1 for the chords at both
//            ends of a while, then n.(a - b) > 0 for the world lines throughout
//   reach    as in proofs/prover/direction.h, whose error bound is 2^-47 |n|_1 reach: raised by 2^47 margin it is a
//            bound for both. (The sum and products round by at most 5 u of the margin's share; 2^-40 is added to it.)
#pragma once

#include <algorithm>

#include "noli/proofs/prover/chord.h"
#include "noli/proofs/prover/direction.h"
#include "noli/proofs/prover/moving_cell.h"

namespace noli {

template <int Dim>
struct WindowCell : MovingCell<Dim> {
  std::array<double, Dim> radius;
  bool scripted;  ///< all its vertices are
};

/// The cell with the chords over [begin, end] of the corners in a part; what it says about others is meaningless.
template <int Dim>
WindowCell<Dim> over(const WindowCell<Dim>& cell, CornerMask part, const WorldLines& lines, double begin, double end) {
  WindowCell<Dim> c = cell;
  c.radius = {};
  for (std::size_t i = 0; i < 3; ++i) {
    if ((part >> i & 1) == 0) continue;
    const Chord<Dim> chord = chord_of<Dim>(WorldLine(lines, c.vertices[i]), begin, end);
    for (std::size_t k = 0; k < Dim; ++k) {
      c.x[0][k][i] = chord.x_t0[k];
      c.x[1][k][i] = chord.x_t1[k];
      c.radius[k] = std::max(c.radius[k], chord.radius[k]);
    }
  }
  if constexpr (Dim == 3) {
    if (part == all_corners(3)) c.normal = detail::mid_normal(c);
  }
  return c;
}

template <int Dim>
double margin_of(const WindowCell<Dim>& a, const WindowCell<Dim>& b) {
  double margin = 0;
  for (std::size_t k = 0; k < Dim; ++k) margin = std::max(margin, a.radius[k] + b.radius[k]);
  return margin;
}

/// A reach that stands for rounding and margin.
inline double raised(double reach, double margin) { return reach + 0x1p47 * (margin + 0x1p-40 * margin); }

}  // namespace noli
