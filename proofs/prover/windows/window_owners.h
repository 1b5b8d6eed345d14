// SPDX-License-Identifier: Apache-2.0
//
// Which cell a vertex or edge belongs to when pairs of scripted cells are not looked at.
//
// A pair of features counts if some pair of cells that have them is looked at. It is examined where the obligations of
// its two owners are; so a feature that a cell has which is not scripted must not belong to a scripted one.
//
// What this does not do: it looks at no coordinates.
#pragma once

#include <cstdint>
#include <vector>

#include "proofs/prover/cells/features.h"

namespace noli {

/// Passes corners and edges that belong to a scripted cell on to the least cell that has them and is not scripted,
/// where there is one. `labels`: as in proofs/prover/cells/labels.h.
void prefer_free_owners(const Mesh& mesh, const std::vector<std::uint32_t>& labels, CellFeatures& features);

}  // namespace noli
