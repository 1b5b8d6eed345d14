// SPDX-License-Identifier: Apache-2.0
//
// Assigns vertices and edges to cells when pairs of scripted cells are not compared.
//
// A pair of features counts if some pair of cells that have them is compared. It is examined at the obligation of its
// two owners. So a feature of a cell that is not scripted must not belong to a scripted one.
#pragma once

#include <cstdint>
#include <vector>

#include "proofs/prover/cells/features.h"

namespace noli {

/// Moves corners and edges from a scripted owner to the least cell that has them and is not scripted, if there is one.
/// `labels`: as in proofs/prover/cells/labels.h.
void prefer_free_owners(const Mesh& mesh, const std::vector<std::uint32_t>& labels, CellFeatures& features);

}  // namespace noli
