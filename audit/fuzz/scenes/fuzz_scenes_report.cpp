// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/scenes/fuzz_scenes_report.h"

#include <fmt/format.h>

#include "audit/fuzz/finding_report.h"

namespace noli::audit {

Json fuzz_json(const SceneFuzzOptions& options, const SceneFuzzReport& report) {
  Json json = {{"verdict", report.verdict()},       {"seed", options.limits.seed}, {"scenes", report.items},
               {"findings", report.findings_total}, {"verified", report.verified}, {"resumed", report.resumed}};
  json["ends"] = Json::object();
  for (const auto& [generator, ends] : report.ends) {
    for (const auto& [end, count] : ends) json["ends"][generator][end] = count;
  }
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) json["reports"].push_back(finding_json(finding, "file"));
  return json;
}

std::string fuzz_text(const SceneFuzzOptions& options, const SceneFuzzReport& report) {
  std::string text;
  for (const auto& finding : report.findings) text += finding_line(finding, "scene");
  for (const auto& [generator, ends] : report.ends) {
    text += fmt::format("  {:17}", generator);
    for (const auto& [end, count] : ends) text += fmt::format(" {} {};", end, count);
    text += '\n';
  }
  if (options.corpus) text += fmt::format("Corpus: {} scenes.\n", report.corpus_size);
  return text;
}

std::vector<std::string> fuzz_pairs(const SceneFuzzReport& /*report*/) {
  return {"scenes", "findings", "verified", "resumed", "seed"};
}

Json scene_facts(const SceneJudgement& judgement) {
  return {{"end", judgement.end}, {"verified", judgement.verified}, {"resumed", judgement.resumed}};
}

}  // namespace noli::audit
