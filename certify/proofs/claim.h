// SPDX-License-Identifier: Apache-2.0
//
// Claims as a verification makes them and as JSON. What they are: include/noli/proof.h.
#pragma once

#include <cstdint>
#include <span>

#include <noli/mesh.h>
#include <noli/proof.h>
#include "certify/json.h"
#include "proofs/prover/cells/labels.h"

namespace noli {

/// Sets what the cells (after merging) and their labels say: their hash, what is excluded, and whether the claim is
/// empty; `strict` is set before.
void set_cells(Claim& claim, const Mesh& mesh, std::span<const std::uint32_t> labels, const LabelPairs& excluded);

/// Its order is that of the claim's line, its types are those that CLAIM.json may have.
Json claim_json(const Claim& claim);

/// {"name": text, "version": text, "commit": text}
Json checker_json(const CheckerVersion& checker);

/// The file CLAIM.json: schema "noli-claim", version 1.
Json claim_file(const Claim& claim);

}  // namespace noli
