// SPDX-License-Identifier: Apache-2.0
//
// The proof of `noli verify FRAMES...`, step by step beside the verifier.
#pragma once

#include <filesystem>
#include <optional>

#include <noli/sequence.h>
#include <noli/verify.h>
#include "certify/proofs/step_proofs.h"
#include "trajectory/merge.h"

namespace noli {

/// What is asked of frames. `outcome`: what is known of them before the first step.
Claim claim_of_frames(const VerifyRequest& request, const VerifyOutcome& outcome, const Mesh& mesh,
                      const Exclusions* exclusions);

class FrameProof {
 public:
  /// `mesh` is what is compared (after merging), `exclusions` or none what of it is not; the rest is what
  /// the claim says of it. `x`: positions where the first step begins, by which cells are put into a tree. Writes to
  /// request.open_proof(claim).
  FrameProof(const VerifyRequest& request, const Claim& claim, int dimension, const Mesh& mesh,
             const IdenticalVertices* classes, const Exclusions* exclusions, std::span<const Position> x);

  /// Whether the verifier's proofs do for a request: those that know neither a least distance nor exclusions.
  static bool is_by_verifier(const VerifyRequest& request) { return request.min_distance == 0 && !request.ignore; }

  /// Writes the proof of a step that has no contact and commits it. Precondition: is_by_verifier(request).
  void write(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1, const StepProof& proof);

  /// Finds the proof of a step that has no contact, writes and commits it. False if it was stopped, which leaves the
  /// file as it was. Precondition: not is_by_verifier(request).
  bool prove(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1,
             const VerifyOptions& options);

  /// Writes a witness for a step that has a contact, and commits it. False if none was found.
  bool refute(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1,
              const StepResult& result);
  /// The same for one in which something comes nearer than the least distance.
  bool refute(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1, const TooNear& near);

  /// The largest least distance that positions allow, if it is less than what was asked for. Precondition: not
  /// is_by_verifier(request).
  std::optional<LargestDistance> largest(std::span<const Position> x, const VerifyOptions& options) const {
    return proofs_.largest(*prover_, x, options);
  }

 private:
  MotionStep at(std::size_t step, const WorldLines& lines) const {
    return {step, lines, rest_ ? 0 : static_cast<double>(step)};
  }

  bool rest_;
  std::vector<std::uint32_t> leaf_cells_;  ///< of the tree that was written last, with the verifier's proofs
  StepProofs proofs_;
  std::optional<WindowVerifier> prover_;  ///< where the verifier's proofs do not do
};

}  // namespace noli
