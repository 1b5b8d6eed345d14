// SPDX-License-Identifier: Apache-2.0
//
// The proofs of a run's windows: of `noli simulate`, and of `noli verify RUN --proof OUT`.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "noli/proofs/prover/proof_file.h"
#include "noli/proofs/prover/step_prover.h"
#include "noli/trajectory/run_file.h"

namespace noli::app {

class RunProof {
 public:
  /// `x`: positions at the beginning of the run, by which cells are put into a tree. The scene has to outlive this.
  RunProof(std::unique_ptr<Sink> sink, const RunScene& scene, std::span<const Position> x, bool strict);

  /// Writes the proof of a window in which nothing touches and commits it. False if it was stopped, which leaves the
  /// file as it was.
  bool prove(std::uint64_t window, const WorldLines& lines, const VerifyOptions& options);

 private:
  RunProof(std::unique_ptr<Sink> sink, const RunScene& scene, std::span<const Position> x, bool strict,
           const std::vector<std::uint32_t>& labels);

  bool tree_written_ = false;
  StepProver prover_;
  ProofFile file_;
};

}  // namespace noli::app
