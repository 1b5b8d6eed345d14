// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/finding_report.h"

#include <fmt/format.h>

#include <noli/errors.h>

namespace noli::audit {

std::string finding_line(const FuzzFinding& finding, const char* item, const std::string& more) {
  return fmt::format("finding: {}, block {}, {} {}: {}; {}\n", finding.generator, finding.block, item, finding.index,
                     on_one_line(more + finding.difference),
                     finding.place.empty() ? "not saved" : "saved as " + on_one_line(finding.place.string()));
}

Json finding_json(const FuzzFinding& finding, const char* place) {
  return {{"generator", finding.generator},
          {"block", finding.block},
          {"index", finding.index},
          {"difference", finding.difference},
          {place, finding.place.string()}};
}

Json replay_json(const ReplayResult& judged, const char* place) {
  const bool finding = judged.difference.has_value();
  Json json = {{"verdict", judged.unknown ? "undecided" : finding ? "finding" : "no_finding"}};
  json.update(judged.facts);
  json["difference"] = finding ? Json(*judged.difference) : Json();
  json[place] = judged.saved ? Json(judged.saved->string()) : Json();
  return json;
}

report::Answer replay_answer(const Json& json, const ReplayResult& judged) {
  report::Answer answer(json, judged.pairs);
  answer.text = judged.text;
  if (judged.difference) answer.text += on_one_line(*judged.difference) + '\n';
  if (judged.saved) answer.text += "saved as " + on_one_line(judged.saved->string()) + judged.about_saved + '\n';
  return answer;
}

}  // namespace noli::audit
