// SPDX-License-Identifier: Apache-2.0
//
// Mutants of good proofs: wrong in one place or a few, and sometimes still right. What the checkers have to say of one
// is decided elsewhere (audit/fuzz/proofs/proof_judge.h).
//
// Most mutations know the format and put lengths, checksums and hashes right afterwards, so that the mutant reaches
// what lies behind them; others are of plain bytes, or leave one hash wrong.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audit/fuzz/random.h"
#include "audit/fuzz/trajectories/frame_motion.h"
#include "certify/proofs/proof_blocks.h"

namespace noli::audit {

/// A good proof, and the trajectory that it is about.
struct ProofCase {
  std::string name;
  std::string proof;               ///< its bytes
  ProofGroups groups;              ///< the same taken apart
  std::string extension;           ///< of the trajectory's files: "ply", "obj", "blocks"
  std::vector<std::string> files;  ///< their bytes
  bool refutes = false;            ///< it is accepted as a witness of contact
};

struct ProofMutant {
  std::string mutations;                          ///< their names, joined by +
  std::string proof;                              ///< bytes
  std::optional<std::vector<std::string>> files;  ///< of the trajectory, where it was changed
};

/// A proof on its way to being a mutant.
struct Mutating {
  const ProofCase& from;
  std::span<const ProofCase> others;  ///< proofs to take parts from
  Random& random;
  ProofGroups groups;
  std::optional<FrameMotion> frames;  ///< changed frames
  bool fits = false;                  ///< hashes of cells and motion are to be those of the changed claim and frames
};

struct ProofMutation {
  std::string_view name;
  std::uint64_t weight;
  bool (*apply)(Mutating& mutating);  ///< false: there was nothing that it could change
};

/// All that know the format.
std::span<const ProofMutation> proof_mutations();

/// Where they are: mutate_tokens.cpp, ...
std::vector<ProofMutation> mutations_of_tokens();
std::vector<ProofMutation> mutations_of_witnesses();
std::vector<ProofMutation> mutations_of_claims();  ///< and of steps, trees, blocks
std::vector<ProofMutation> mutations_of_frames();

ProofMutant make_mutant(const ProofCase& from, std::span<const ProofCase> others, Random& random);

}  // namespace noli::audit
