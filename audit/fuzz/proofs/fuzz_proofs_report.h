// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of `noli fuzz proofs`: text and JSON of a run, and facts about a saved proof that is judged again.
#pragma once

#include <string>
#include <vector>

#include "audit/fuzz/proofs/fuzz_proofs.h"
#include "certify/json.h"

namespace noli::audit {

/// Without `timing`.
Json fuzz_json(const ProofFuzzOptions& options, const ProofFuzzReport& report);
std::string fuzz_text(const ProofFuzzOptions& options, const ProofFuzzReport& report);
/// Members of that JSON for the line of --porcelain; the report only selects the overload.
std::vector<std::string> fuzz_pairs(const ProofFuzzReport& report);

/// The answers of both checkers, and whether the claim is true.
Json proof_facts(const ProofJudgement& judgement);

}  // namespace noli::audit
