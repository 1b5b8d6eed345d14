// SPDX-License-Identifier: Apache-2.0
//
// Makes a mutant that fails as like the good proof as possible: its files, blocks and bytes are put back one by one, as
// long as it still fails.
//
// What this does not do: it leaves no token out, so a mutant of another length stays as long as it is.
#pragma once

#include <functional>

#include "audit/fuzz/proofs/proof_mutations.h"

namespace noli::audit {

/// Precondition: fails(mutant).
ProofMutant minimise(const ProofCase& from, const ProofMutant& mutant,
                     const std::function<bool(const ProofMutant&)>& fails);

}  // namespace noli::audit
