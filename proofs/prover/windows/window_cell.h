// SPDX-License-Identifier: Apache-2.0
//
// A cell whose corners move along world lines: their chords over a time interval, and how far they stray from them.
//
// Notation
//   radius   per axis, the greatest of the radii of the corners' chords (proofs/prover/windows/chord.h)
//   margin   the sum of the radii of two cells, maximised over the axes. If n.(a - b) > margin |n|_1 for the chords at
//            both ends of an interval, then n.(a - b) > 0 for the world lines throughout
//   reach    as in proofs/prover/cells/direction.h, whose error bound is 2^-47 |n|_1 reach: raised by 2^47 margin it is
//            a bound for both. (The sum and products round by at most 5 u of the margin's share; 2^-40 is added to it.)
//
// As in proofs/prover/cells/moving_cell.h, the usual obligations are settled from ChordCell; for the rest, positions
// are gathered in a WindowCell.
#pragma once

#include <algorithm>

#include "proofs/prover/cells/direction.h"
#include "proofs/prover/cells/moving_cell.h"
#include "proofs/prover/windows/window_chords.h"

namespace noli {

/// A cell of a mesh in a span.
template <int Dim>
struct ChordCell : CellIndices {
  static constexpr int dim = Dim;
  const VertexChord<Dim>* mesh_vertices;  ///< those of the whole mesh

  const VertexChord<Dim>& chord(std::size_t corner) const { return mesh_vertices[vertices[corner]]; }
  const std::array<BothEnds, Dim>& x(std::size_t corner) const { return chord(corner).x; }
  double radius_along(std::size_t axis) const {
    return std::max(chord(0).radius[axis], std::max(chord(1).radius[axis], chord(2).radius[axis]));
  }
};

/// A cell of a mesh in a span, with its positions.
template <int Dim>
struct WindowCell : MovingCell<Dim> {
  std::array<double, Dim> radius;

  double radius_along(std::size_t axis) const { return radius[axis]; }
};

/// The margin of two cells, ChordCell or WindowCell.
template <class Cell>
double margin_of(const Cell& a, const Cell& b) {
  double margin = 0;
  for (std::size_t k = 0; k < Cell::dim; ++k) margin = std::max(margin, a.radius_along(k) + b.radius_along(k));
  return margin;
}

/// A reach that covers both rounding and margin.
inline double raised(double reach, double margin) { return reach + 0x1p47 * (margin + 0x1p-40 * margin); }

template <int Dim>
double widened(double reach, const ChordCell<Dim>& a, const ChordCell<Dim>& b) {
  return raised(reach, margin_of(a, b));
}
template <int Dim>
double widened(double reach, const WindowCell<Dim>& a, const WindowCell<Dim>& b) {
  return raised(reach, margin_of(a, b));
}

template <int Dim>
WindowCell<Dim> gather(const ChordCell<Dim>& cell) {
  WindowCell<Dim> c{};
  gather_corners(cell, c);
  for (std::size_t k = 0; k < Dim; ++k) c.radius[k] = cell.radius_along(k);
  return c;
}

/// The cell with the chords over [begin, end] of the corners in a part; other corners are meaningless.
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
  if constexpr (Dim == 3) c.normal = part == all_corners(3) ? detail::mid_normal(c) : std::array<double, 3>{};
  return c;
}

}  // namespace noli
