// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/fuzz_proofs_report.h"

#include <fmt/format.h>

#include "audit/fuzz/finding_report.h"

namespace noli::audit {
namespace {

Json tally_json(const CodeTally& tally) {
  return {
      {"accepted", tally.accepted}, {"refuted", tally.refuted}, {"rejected", tally.rejected}, {"failed", tally.failed}};
}

}  // namespace

Json fuzz_json(const ProofFuzzOptions& options, const ProofFuzzReport& report) {
  Json json = {{"verdict", report.verdict()},    {"seed", options.limits.seed},
               {"mutants", report.items},        {"findings", report.findings_total},
               {"proofs", options.cases.size()}, {"checked_verified", report.checked_verified},
               {"judged", report.judged},        {"not_judged", report.not_judged},
               {"corpus", report.corpus_size},   {"codes", tally_json(report.codes)}};
  json["mutations"] = Json::object();
  for (const auto& [name, tally] : report.mutations) json["mutations"][name] = tally_json(tally);
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) {
    json["reports"].push_back({{"proof", finding.generator},
                               {"mutations", finding.mutations},
                               {"block", finding.block},
                               {"index", finding.index},
                               {"difference", finding.difference},
                               {"folder", finding.place.string()}});
  }
  return json;
}

std::string fuzz_text(const ProofFuzzOptions& options, const ProofFuzzReport& report) {
  std::string text;
  for (const auto& finding : report.findings)
    text += finding_line(finding, "mutant", finding.mutations.empty() ? "" : finding.mutations + ": ");
  for (const auto& [name, tally] : report.mutations) {
    text += fmt::format("  {:26} accepted {:7} refuted {:7} rejected {:7} failed {:7}\n", name, tally.accepted,
                        tally.refuted, tally.rejected, tally.failed);
  }
  if (options.corpus) text += fmt::format("Corpus: {} proofs.\n", report.corpus_size);
  return text + fmt::format("Proofs: {}. The verified checker looked at {} mutants. Not judged: {}.\n",
                            options.cases.size(), report.checked_verified, report.not_judged);
}

std::vector<std::string> fuzz_pairs(const ProofFuzzReport& /*report*/) {
  return {"mutants",
          "findings",
          "accepted=codes/accepted",
          "refuted=codes/refuted",
          "rejected=codes/rejected",
          "failed=codes/failed",
          "judged",
          "seed"};
}

Json proof_facts(const ProofJudgement& judgement) {
  const char* const truth = !judgement.truth ? "not_judged" : *judgement.truth ? "true" : "false";
  return {{"plain", word_of(judgement.plain)},
          {"words", judgement.plain.words},
          {"verified", judgement.verified ? word_of(*judgement.verified) : "not_asked"},
          {"claim", truth}};
}

}  // namespace noli::audit
