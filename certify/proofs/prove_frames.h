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

/// Whether the verifier's proofs do for a request: those that know neither a least distance nor exclusions.
inline bool verifier_proves(const VerifyRequest& request) { return request.min_distance == 0 && !request.ignore; }

/// The proof of a claim, which goes to request.open_proof(claim). `mesh` is what is compared (after merging), which has
/// to outlive it, `exclusions` what of it is not, or nullptr; the rest is what the claim says of it.
std::unique_ptr<StepProofs> proof_of_frames(const VerifyRequest& request, const Claim& claim, const Mesh& mesh,
                                            const IdenticalVertices* classes, const Exclusions* exclusions);

}  // namespace noli
