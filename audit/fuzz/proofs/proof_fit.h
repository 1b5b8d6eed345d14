// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "audit/fuzz/proofs/proof_mutations.h"

namespace noli::audit {

/// Makes the hashes in the claim and the steps of a mutant those of its claim and frames, where it has any that can be
/// read.
void fit_hashes(Mutating& mutating);

}  // namespace noli::audit
