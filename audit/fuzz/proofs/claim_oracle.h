// SPDX-License-Identifier: Apache-2.0
//
// Whether a claim about frames is true, by its words alone (proofs/FORMAT.md, section 1): all pairs of cells, all pairs
// of their parts, by the slow oracle. Labels, merged vertices, a least distance, rings of neighbours, features of one
// cell.
//
// What this does not do: runs; a mutant of a run is compared with what it was made of, or not judged.
#pragma once

#include "audit/fuzz/trajectories/frame_motion.h"
#include "certify/proofs/parsed_claim.h"

namespace noli::audit {

/// Preconditions: source 0 or 1, dimension 2 or 3, eta finite and not negative, frames with steps for that source.
bool claim_holds(const ParsedClaim& claim, const Mesh& claimed, const std::vector<std::vector<Position>>& frames);

}  // namespace noli::audit
