// SPDX-License-Identifier: Apache-2.0
//
// A cell whose corners go along world lines: their chords over a while, and how far they stray.
//
// Notation
//   radius   per axis, the greatest of the radii of the corners' chords (proofs/prover/windows/chord.h)
//   margin   the greatest radius of two cells, added, over the axes. If n.(a - b) > margin |n|_1 for the chords at both
//            ends of a while, then n.(a - b) > 0 for the world lines throughout
//   reach    as in proofs/prover/cells/direction.h, whose error bound is 2^-47 |n|_1 reach: raised by 2^47 margin it is
//            a bound for both. (The sum and products round by at most 5 u of the margin's share; 2^-40 is added to it.)
//
// What this does not do: it has no normal; `normal` is zero until somebody needs one.
#pragma once

#include <algorithm>

#include "proofs/prover/cells/direction.h"
#include "proofs/prover/cells/moving_cell.h"
#include "proofs/prover/windows/window_chords.h"

namespace noli {

template <int Dim>
struct WindowCell : MovingCell<Dim> {
  std::array<double, Dim> radius;
};

namespace detail {

template <int Dim>
void set_corner(WindowCell<Dim>& cell, std::size_t i, const auto& chord) {
  for (std::size_t k = 0; k < Dim; ++k) {
    cell.x[0][k][i] = chord.x_t0[k];
    cell.x[1][k][i] = chord.x_t1[k];
    cell.radius[k] = std::max(cell.radius[k], static_cast<double>(chord.radius[k]));
  }
}

template <int Dim>
void set_names(WindowCell<Dim>& cell, const Leaf& leaf) {
  cell.vertices = leaf.vertices;
  cell.cell = leaf.cell;
  cell.owned = leaf.owned;
  cell.shared = leaf.shared;
  cell.corners = leaf.corners;
}

}  // namespace detail

/// The cell with the chords of its corners.
template <int Dim>
WindowCell<Dim> cell_of(const Leaf& leaf, const WindowChords<Dim>& chords) {
  WindowCell<Dim> cell;
  cell.normal = {};
  cell.radius = {};
  for (std::size_t i = 0; i < 3; ++i) detail::set_corner(cell, i, chords.of[leaf.vertices[i]]);
  for (auto& end : cell.x) {
    for (auto& axis : end) axis[3] = axis[2];
  }
  detail::set_names(cell, leaf);
  return cell;
}

/// The cell with the chords over [begin, end] of the corners in a part; what it says about others is meaningless.
template <int Dim>
WindowCell<Dim> over(const WindowCell<Dim>& cell, CornerMask part, const WorldLines& lines, double begin, double end) {
  WindowCell<Dim> c = cell;
  c.radius = {};
  for (std::size_t i = 0; i < 3; ++i) {
    if ((part >> i & 1) == 0) continue;
    detail::set_corner(c, i, chord_of<Dim>(WorldLine(lines, c.vertices[i]), begin, end));
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
