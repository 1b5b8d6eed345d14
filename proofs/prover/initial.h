// SPDX-License-Identifier: Apache-2.0
//
// Decides exactly whether two parts meet at the beginning of the step.
//
// Notation
//   part  some corners of a cell: a point, a segment or a triangle (any of them possibly degenerate)
//
// This is not the same as a pair of features in contact at t = 0: an edge that pierces a face meets it away from all
// its corners and edges, and in 2D a point may be inside a face.
#pragma once

#include "proofs/prover/cells/direction.h"
#include "proofs/prover/cells/moving_cell.h"

namespace noli {

/// Whether the hulls of the two parts, neither of them empty, have a point in common at t = 0.
template <int Dim>
bool meet_at_begin(const MovingCell<Dim>& a, CornerMask a_part, const MovingCell<Dim>& b, CornerMask b_part);

}  // namespace noli
