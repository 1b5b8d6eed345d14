// SPDX-License-Identifier: Apache-2.0
//
// The proof of `noli verify FRAMES...`, step by step beside the verifier.
#pragma once

#include <memory>

#include <noli/verify.h>
#include "certify/proofs/step_proofs.h"
#include "trajectory/merge.h"

namespace noli {

/// What is asked of frames. `outcome`: what is known of them before the first step.
Claim claim_of_frames(const VerifyRequest& request, const VerifyOutcome& outcome, const Mesh& mesh,
                      const Exclusions* exclusions);

/// Whether verify_step itself can prove the request: its proofs have neither a least distance nor exclusions.
inline bool verifier_proves(const VerifyRequest& request) { return request.min_distance == 0 && !request.ignore; }

/// Begins the proof of a claim in request.open_proof(claim). `mesh`: the compared mesh after merging; it must outlive
/// the proof. `exclusions`: pairs that are not compared, or nullptr.
std::unique_ptr<StepProofs> proof_of_frames(const VerifyRequest& request, const Claim& claim, const Mesh& mesh,
                                            const IdenticalVertices* classes, const Exclusions* exclusions);

}  // namespace noli
