// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the checkers of proofs: mutants of good proofs and of the trajectories that they are about
// (audit/fuzz/proofs/proof_mutations.h), on which the checkers have to agree, and none of which may be accepted that
// says what is not true.
//
// Notation
//   case     a good proof that mutants are made of
//   truth    whether a mutant's claim holds of its trajectory. Where neither was changed, what was true of the case is;
//            where one was, the slow oracle tells (audit/fuzz/proofs/claim_oracle.h), whatever the proof says
//   finding  a mutant on which the two checkers differ; that one of them accepts as a proof although its claim is
//            false, or as a witness although it is true; on which one crashes, hangs, or ends as it must not
//
// What this does not do: a mutant that is rejected although its proof is good is none; a changed claim about a run is
// not judged, the checkers are only compared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audit/fuzz/fuzzing.h"
#include "audit/fuzz/proofs/proof_judge.h"
#include "audit/fuzz/proofs/proof_mutations.h"

namespace noli::audit {

struct ProofFuzzOptions : FuzzSettings {
  std::vector<ProofCase> cases;  ///< at least one
  MakeCheckers make_checkers;    ///< plain: asked about every mutant
  std::uint64_t verified_every =
      50;  ///< asked about one mutant of so many, and all that are accepted of a changed claim
};

/// `generator` is the name of the case.
struct ProofFinding : FuzzFinding {
  std::string mutations;
  ProofFiles files;  ///< the mutant, made simpler: as much as possible is as in the case
};

/// What the plain checker said, and how often it failed to say anything.
struct CodeTally {
  std::uint64_t accepted = 0, refuted = 0, rejected = 0, failed = 0;

  std::uint64_t all() const { return accepted + refuted + rejected + failed; }
};

struct ProofFuzzReport : FuzzTotals {
  CodeTally codes;
  std::map<std::string, CodeTally> mutations;  ///< by name
  std::uint64_t checked_verified = 0;
  std::uint64_t judged = 0;      ///< accepted or refuted, of a changed claim or trajectory, and decided by the oracle
  std::uint64_t not_judged = 0;  ///< the same, about a run
  std::vector<ProofFinding> findings;
};

/// A finding as a folder, with a README: what it is, its difference, and the command that shows it again. All of it or
/// nothing (audit/fuzz/save_finding.h). Throws std::system_error.
void save_finding(const ProofFiles& files, const std::string& what, const std::string& difference,
                  const std::filesystem::path& folder);

/// Makes a mutant that fails as like the good proof as possible: its files, blocks and bytes are put back one by one
/// while it still fails. No token is left out, so a mutant of another length stays as long as it is. Precondition:
/// fails(mutant).
ProofMutant minimise(const ProofCase& from, const ProofMutant& mutant,
                     const std::function<bool(const ProofMutant&)>& fails);

/// Runs until a limit; with a count and without a corpus the report is the same for any number of threads. What
/// cannot be saved is in `not_saved`. Throws InputError for a corpus that cannot be read, std::system_error when
/// the machine fails.
ProofFuzzReport fuzz_proofs(const ProofFuzzOptions& options);

}  // namespace noli::audit
