// SPDX-License-Identifier: Apache-2.0
//
// Writes the steps of a proof; a step is between two frames, or a window of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/findings.h>
#include "proofs/prover/cells/labels.h"
#include "proofs/prover/tokens/mesh_paths.h"
#include "proofs/prover/tokens/no_proof.h"
#include "proofs/prover/tokens/proof_file.h"
#include "proofs/prover/verifier.h"
#include "proofs/prover/windows/window_verifier.h"
#include "proofs/prover/witness/witness.h"

namespace noli {

/// A step of a motion. `lines` must outlive it.
struct MotionStep {
  std::uint64_t number;  ///< from 0
  const WorldLines& lines;
  double shift = 0;                    ///< its times are exactly those of the lines plus this
  std::optional<Sha256Digest> hash{};  ///< of a window's group in trajectory.blocks
};

/// Passes on blocks, kind and payload.
using BlocksOfStep = std::function<void(const std::function<void(FourLetters, std::string_view)>& take)>;

class StepProofs {
 public:
  using Open = std::function<ProofFile(const ProofHeader&)>;

  /// `mesh`: the compared mesh, which must outlive this. `header`: everything except labels and exclusions, which are
  /// in `labels`.
  StepProofs(const Mesh& mesh, ProofHeader header, CellLabels labels, const Open& open);
  StepProofs(const StepProofs&) = delete;
  StepProofs& operator=(const StepProofs&) = delete;

  /// The next proof brings its tree, as the first one of a chain does (proofs/prover/chain.h).
  void begin_chain();
  /// Finds and writes the proof of a step in which nothing touches; call commit() to make it count. `verifier`: of the
  /// mesh, the same for all steps. Returns false if it was stopped. Throws TooNear and NoProof. In all three cases the
  /// file stays as it was.
  bool prove(const MotionStep& step, const WindowVerifier& verifier, const VerifyOptions& options);
  /// Writes a finished proof and commits it.
  void write(const MotionStep& step, const StepProof& proof);
  /// Does the same with a proof that comes piece by piece.
  class Writer;
  void commit();

  /// Copies the blocks of a step from another file, and commits them. Of a run, the first step alone brings its tree.
  /// `blocks` passes on the blocks, STEP first. Returns false if it passes on no block. Throws std::invalid_argument
  /// when they are about another motion.
  bool copy(const MotionStep& step, const BlocksOfStep& blocks);

  /// Joins the tree and the tokens of a step that was proved in parts, and commits them. Returns false if `parts`
  /// passes on no block. Unlike copy(), it does not see which motion the parts are about: the caller compares the
  /// files.
  bool join(const MotionStep& step, const BlocksOfStep& parts);

  /// Writes a witness for a step that has a contact, and commits it. False if none was found.
  bool refute(const MotionStep& step, const std::optional<FeatureContact>& first, const Findings& findings);
  /// The same for a step in which something comes nearer than the least distance.
  bool refute(const MotionStep& step, const TooNear& near);

  /// The largest least distance that holds for the positions at the beginning of a step, if it is less than what was
  /// asked for.
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
  bool tree_due_;                          ///< the next proof brings its tree
  std::vector<std::uint32_t> leaf_cells_;  ///< of the last tree from verify_step()
};

/// Takes the proof of a step while it is found. Both arguments must outlive this.
class StepProofs::Writer : public ProofReceiver {
 public:
  Writer(StepProofs& proofs, const MotionStep& step) : proofs_(proofs), step_(step) {}

  void tree(std::span<const std::uint32_t> leaf_cells) override { leaf_cells_ = leaf_cells; }
  void tokens(std::string_view bytes) override;
  /// Makes the proof count.
  void commit();
  /// Drops what was written.
  void discard();
  /// Wall clock of writing, and so of waiting for whoever reads.
  double seconds() const { return seconds_; }

 private:
  void begin();

  StepProofs& proofs_;
  const MotionStep& step_;
  std::span<const std::uint32_t> leaf_cells_;
  bool begun_ = false;
  double seconds_ = 0;
  const std::function<void(std::string_view)> put_ = [this](std::string_view payload) {
    proofs_.file_.tokens(payload);
  };
  TokenBlocks blocks_{put_};
};

/// The positions of the vertices at the beginning of the lines.
std::vector<Position> beginning_of(const WorldLines& lines);

}  // namespace noli
