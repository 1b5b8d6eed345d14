// SPDX-License-Identifier: Apache-2.0
//
// Makes claims (include/noli/proof.h) for a verification, and converts them to JSON.
#pragma once

#include <cstdint>
#include <span>

#include <noli/mesh.h>
#include <noli/proof.h>
#include "certify/json.h"
#include "proofs/prover/cells/labels.h"

namespace noli {

/// Sets the members that depend on the cells (after merging) and their labels: their hash, excluded pairs, and whether
/// the claim is empty. Precondition: `strict` is set.
void set_cells(Claim& claim, const Mesh& mesh, std::span<const std::uint32_t> labels, const LabelPairs& excluded);

/// Whether a checker can be asked about it: not if it lists more excluded pairs than fit its words.
bool can_be_asked(const Claim& claim);

/// The members in the order of the claim's line, with the types of CLAIM.json.
Json claim_json(const Claim& claim);

/// {"name": text, "version": text, "commit": text}
Json checker_json(const CheckerVersion& checker);

/// The file CLAIM.json: schema "noli-claim", version 1.
Json claim_file(const Claim& claim);

}  // namespace noli
