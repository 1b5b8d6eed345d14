// SPDX-License-Identifier: Apache-2.0
//
// Makes the proof of `noli verify FRAMES...`, step by step alongside the verifier.
#pragma once

#include <memory>

#include <noli/verify.h>
#include "certify/proofs/step_proofs.h"
#include "trajectory/merge.h"

namespace noli {

/// Labels of cells for what is not compared: groups of vertices have the labels of the groups (`exclusions`, or
/// nullptr); then all cells of a group that intersect the same cells of the baseline have a label of their own, above
/// those, in the order of cells.
CellLabels labels_of_frames(const Mesh& mesh, const Exclusions* exclusions,
                            const std::vector<InitialIntersection>& baseline);

/// The claim that is asked for. `outcome`: what is known about the frames before the first step.
Claim claim_of_frames(const VerifyRequest& request, const VerifyOutcome& outcome, const Mesh& mesh,
                      const CellLabels& labels);

/// Whether verify_step itself can prove the request: its proofs have neither a least distance nor exclusions.
inline bool verifier_proves(const VerifyRequest& request) {
  return request.min_distance == 0 && !request.ignore && !request.only_new;
}

/// Begins the proof of a claim in request.open_proof(claim). `mesh`: the compared mesh after merging; it must outlive
/// the proof.
std::unique_ptr<StepProofs> proof_of_frames(const VerifyRequest& request, const Claim& claim, const Mesh& mesh,
                                            const IdenticalVertices* classes, const CellLabels& labels);

}  // namespace noli
