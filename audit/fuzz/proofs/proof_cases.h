// SPDX-License-Identifier: Apache-2.0
//
// The proofs that `noli fuzz proofs` begins with: one that is given, or those that `noli verify` writes of small
// motions.
#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "audit/fuzz/proofs/proof_mutations.h"

namespace noli::audit {

/// files[0] is a proof or witness that the checker accepts; the rest are its frames, or its run. Without files: proofs
/// and witnesses of small motions, with various claims. Fewer, or none, once `stop` is set. Precondition: not exactly
/// one file. Throws InputError, and what check_proof() throws.
std::vector<ProofCase> proof_cases(const std::vector<std::filesystem::path>& files, const std::atomic<bool>& stop);

}  // namespace noli::audit
