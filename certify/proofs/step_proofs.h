// SPDX-License-Identifier: Apache-2.0
//
// The steps of a proof, of whatever they are about: two frames, or a window of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <noli/findings.h>
#include "proofs/prover/cells/labels.h"
#include "proofs/prover/tokens/mesh_paths.h"
#include "proofs/prover/tokens/no_proof.h"
#include "proofs/prover/tokens/proof_file.h"
#include "proofs/prover/windows/window_verifier.h"
#include "proofs/prover/witness/witness.h"

namespace noli {

/// A step of a motion. `lines` have to outlive what is done with it.
struct MotionStep {
  std::uint64_t number;  ///< from 0
  const WorldLines& lines;
  double shift = 0;                    ///< its times are those of the lines and this more, exactly
  std::optional<Sha256Digest> hash{};  ///< of a window's group in trajectory.blocks
};

class StepProofs {
 public:
  using Open = std::function<ProofFile(const ProofHeader&)>;

  /// `mesh`: what is compared, which has to outlive this. `header`: all but labels and exclusions, which are `labels`.
  StepProofs(const Mesh& mesh, ProofHeader header, CellLabels labels, const Open& open);
  StepProofs(const StepProofs&) = delete;
  StepProofs& operator=(const StepProofs&) = delete;

  /// Finds and writes the proof of a step in which nothing touches; call commit() to make it count. `verifier`: of the
  /// mesh, the same for all steps. Returns false if it was stopped. Throws TooNear and NoProof. In all three cases the
  /// file stays as it was.
  bool prove(const MotionStep& step, const WindowVerifier& verifier, const VerifyOptions& options);
  /// Writes a finished proof and commits it.
  void write(const MotionStep& step, const StepProof& proof);
  void commit() { file_.commit(); }

  /// Writes a witness for a step that has a contact, and commits it. False if none was found.
  bool refute(const MotionStep& step, const std::optional<FeatureContact>& first, const Findings& findings);
  /// The same for one in which something comes nearer than the least distance.
  bool refute(const MotionStep& step, const TooNear& near);

  /// The largest least distance that the positions where a step begins allow, if it is less than what was asked for.
  std::optional<LargestDistance> largest(const MotionStep& step, const WindowVerifier& verifier,
                                         const VerifyOptions& options) const;

 private:
  void begin(const MotionStep& step, ProofFile::Kind kind);
  WitnessStep what(const MotionStep& step) const;
  bool write_witness(const MotionStep& step, const std::optional<std::string>& witness);

  const Mesh& mesh_;
  CellLabels labels_;
  ProofHeader header_;
  MeshPaths paths_;
  ProofFile file_;
  std::vector<std::uint32_t> leaf_cells_;  ///< of the tree that write() has written last
};

/// Where the vertices are when the lines begin.
std::vector<Position> beginning_of(const WorldLines& lines);

}  // namespace noli
