// SPDX-License-Identifier: Apache-2.0
//
// Boxes of the groups of a hierarchy around chords, with their radii added: if on one axis the boxes of two groups are in
// the same strict order at both ends of the window, it separates the world lines throughout.
//
// Notation
//   phi      as in proofs/prover/hierarchy.h: a monotone map of coordinates to float, here the same at both ends
//
// What this does not do: it makes no hierarchy.
#pragma once

#include <vector>

#include "noli/proofs/prover/hierarchy.h"
#include "noli/proofs/prover/window_cell.h"

namespace noli {

/// The boxes of all nodes. `cells`: in the order of the leaves, their corners' chords over the window.
template <int Dim>
std::vector<GroupBox> window_boxes(const std::vector<WindowCell<Dim>>& cells, int threads);

}  // namespace noli
