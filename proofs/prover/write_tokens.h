// SPDX-License-Identifier: Apache-2.0
//
// The tokens of a step, from the prover into the file: all of them, or the step is dropped.
//
// What this does not do: it neither begins nor commits the step.
#pragma once

#include "proofs/prover/proof_file.h"
#include "proofs/prover/step_prover.h"

namespace noli {

/// False if it was stopped. Throws as StepProver::prove. Precondition: a step was begun.
inline bool write_tokens(ProofFile& file, const StepProver& prover, const WorldLines& lines,
                         const VerifyOptions& options) {
  bool whole = false;
  try {
    whole = prover.prove(lines, options, [&file](std::string_view bytes) { file.tokens(bytes); });
  } catch (...) {
    file.discard();
    throw;
  }
  if (!whole) file.discard();
  return whole;
}

}  // namespace noli
