// SPDX-License-Identifier: Apache-2.0
//
// Judges a mutant of a good proof: whether both checkers say the same, and whether that is true.
//
// Notation
//   truth    whether the claim of a proof holds for its trajectory. If neither was changed, it is that of the case. If
//            one was, the slow oracle decides it (audit/fuzz/proofs/claim_oracle.h), whatever the proof says
//
// What this does not do: a rejected mutant whose proof is good is not a finding. A changed claim about a run is not
// judged; the checkers are only compared.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "audit/fuzz/proofs/proof_checkers.h"
#include "audit/fuzz/proofs/proof_mutations.h"

namespace noli::audit {

/// The checkers of one thread.
struct Checkers {
  std::unique_ptr<ProofChecker> plain;
  std::unique_ptr<ProofChecker> verified;  ///< nothing: there is none
};

/// Called by each thread that asks.
using MakeCheckers = std::function<Checkers()>;

/// noli_check_host, and noli_check_verified if it is there, beside this program. The verified checker ends early when
/// `stop` is set. `stop` must outlive the result and its checkers.
MakeCheckers checkers_beside_this_program(const std::atomic<bool>& stop);

/// What came of one proof.
struct ProofJudgement {
  ProofAnswer plain;
  std::optional<ProofAnswer> verified;  ///< if it was asked
  std::optional<bool> truth;            ///< of the claim, where that is judged and the plain checker did not reject it
  bool judged = false;                  ///< truth was found by the oracle
  bool stopped = false;                 ///< by the user, before the verified checker had answered
  std::string difference;               ///< empty: there is nothing wrong
};

/// The bytes of a mutant, those of the case where they are as they were.
ProofFiles files_of(const ProofCase& from, const ProofMutant& mutant);

/// Asks the plain checker, and the oracle where it does not reject what was changed; and the verified checker if
/// `ask_verified`, and always about what is accepted of a changed claim.
ProofJudgement judge_mutant(const ProofCase& from, const ProofMutant& mutant, const Checkers& checkers,
                            bool ask_verified);

/// Both checkers and the oracle about a proof that was saved.
ProofJudgement judge_proof(const ProofFiles& files, const Checkers& checkers);

/// "accepted", "refuted", "rejected", or "failed".
const char* word_of(const ProofAnswer& answer);

/// A difference without what is different each time, and the plain checker's reason where it rejects: a finding that is
/// made smaller has to stay one of its kind. Empty: there is no difference.
std::string kind_of(const ProofJudgement& judgement);

/// What a proof reached, on one line: where the plain checker rejects it and why, or that it takes what was changed.
std::string shape_of(const ProofJudgement& judgement);

}  // namespace noli::audit
