// SPDX-License-Identifier: Apache-2.0
//
// Writes the proof that nothing touches in a step: the tokens of proofs/FORMAT.md.
//
// Notation
//   step     two frames, or a window of world lines
//   order, ends, labels   as in proofs/prover/tokens/proof_tree.h
//
// The tokens are made by several threads and given away in order: memory grows with the number of threads, not with the
// proof. They depend on the step, the tree, the claim, and nothing else.
//
// What this does not do: it does not find out whether there is a contact. Ask the verifier first: where there is one,
// this gives up only after a long time. It writes no file (proofs/prover/tokens/proof_file.h).
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "proofs/prover/tokens/proof_file.h"
#include "proofs/prover/tokens/proof_walk.h"
#include "proofs/prover/verifier.h"

namespace noli {

/// What is claimed, apart from the motion.
struct ProofClaim {
  int dimension = 3;
  bool strict = false;
  LabelPairs excluded;
  double eta = 0;          ///< the least distance
  std::uint32_t ring = 1;  ///< features that a path of fewer edges joins may be nearer than that
};

class StepProver {
 public:
  /// As ProofTree.
  StepProver(const Mesh& mesh, std::span<const std::uint32_t> order, std::span<const std::uint32_t> ends,
             std::span<const std::uint32_t> labels, ProofClaim claim);

  const ProofTree& tree() const { return *tree_; }
  const ProofClaim& claim() const { return claim_; }
  /// The same with another least distance.
  StepProver with_distance(double eta) const {
    StepProver other = *this;
    other.claim_.eta = eta;
    return other;
  }

  /// Gives `take` the payloads of the blocks TOKS, in order, from one thread at a time. False if it was stopped (stop,
  /// deadline). Throws TooNear, NoProof, std::bad_alloc, and what `take` throws. Of the options only threads, stop and
  /// deadline count.
  bool prove(const WorldLines& lines, const VerifyOptions& options,
             const std::function<void(std::string_view)>& take) const;
  /// The same into a file in which a step was begun: all of the step's tokens, or it is dropped.
  bool write(ProofFile& file, const WorldLines& lines, const VerifyOptions& options) const;

 private:
  ProofClaim claim_;
  std::shared_ptr<const ProofTree> tree_;  ///< paths_ refers to it, in copies too
  MeshPaths paths_;
};

}  // namespace noli
