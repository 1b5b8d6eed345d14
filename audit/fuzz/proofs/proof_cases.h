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

/// The proof in files[0], which the checker has to take, about the frames or the run behind it; without files, proofs
/// and witnesses of small motions, with all sorts of claims. Fewer, or none, when `stop` is set. Throws InputError, and
/// what the checker's process throws.
std::vector<ProofCase> proof_cases(const std::vector<std::filesystem::path>& files, const std::atomic<bool>& stop);

}  // namespace noli::audit
