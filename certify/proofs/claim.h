// SPDX-License-Identifier: Apache-2.0
//
// Claims as a verification makes them and as JSON. What they are: certify/proofs/proof.h.
#pragma once

#include <cstdint>
#include <span>

#include "certify/json.h"
#include "certify/proofs/proof.h"
#include "proofs/prover/tokens/proof_walk.h"
#include "trajectory/mesh.h"

namespace noli {

/// Sets what the cells (after merging) and their labels say: their hash, what is excluded, and whether the claim is
/// empty; `strict` is set before.
void set_cells(Claim& claim, const Mesh& mesh, std::span<const std::uint32_t> labels, const LabelPairs& excluded);

Json claim_json(const Claim& claim);

/// The file CLAIM.json: schema "noli-claim", version 1.
Json claim_file(const Claim& claim);

}  // namespace noli
