// SPDX-License-Identifier: Apache-2.0
//
// Makes a saved proof that fails as small as possible: fewest frames, then steps, blocks and bytes, then bytes that are
// 0. Checksums and hashes are put right each time, if they were. It stays a proof that can be read when it is saved:
// one of no bytes is none.
//
// What this does not do: it changes no frame, as the hashes would not fit then; it knows no tokens, so that it finds
// them by trying which bytes can go.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "audit/fuzz/proofs/proof_checkers.h"
#include "audit/fuzz/proofs/proof_judge.h"

namespace noli::audit {

/// Stops early after so many calls of `fails`. Precondition: fails(files).
ProofFiles minimise(const ProofFiles& files, const std::function<bool(const ProofFiles&)>& fails, std::size_t budget);

struct JudgedProof {
  ProofFiles files;
  ProofJudgement judgement;  ///< of these files
};

/// The same of a finding, for as long as it is one of its kind (audit/fuzz/proofs/proof_judge.h), and until `stop` is
/// set.
JudgedProof minimise_finding(JudgedProof finding, const Checkers& checkers, const std::atomic<bool>& stop,
                             std::size_t budget);

/// Judges a saved proof again. `smaller`: it is made smaller if something is wrong with it.
JudgedProof replay_proof(ProofFiles files, bool smaller, const Checkers& checkers, const std::atomic<bool>& stop);

}  // namespace noli::audit
