// SPDX-License-Identifier: Apache-2.0
//
// Which cells are scripted, and which cell a vertex or edge belongs to when pairs of scripted cells are not looked at.
//
// A pair of features counts if some pair of cells that have them is looked at. It is examined where the obligations of
// its two owners are; so a feature that a cell has which is not scripted must not belong to a scripted one.
//
// What this does not do: it looks at no coordinates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "proofs/prover/cells/features.h"

namespace noli {

/// For each cell 1 if all its vertices are scripted, else 0. `scripted` as in WindowOptions.
std::vector<std::uint8_t> scripted_cells(const Mesh& mesh, std::span<const std::uint8_t> scripted);

/// Passes corners and edges that belong to a scripted cell on to the least cell that has them and is not scripted,
/// where there is one.
void prefer_free_owners(const Mesh& mesh, const std::vector<std::uint8_t>& scripted_cell, CellFeatures& features);

}  // namespace noli
