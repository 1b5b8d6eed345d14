// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/self_report.h"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "audit/ccd/audit_report.h"
#include "kernel/parallel.h"

namespace noli::audit {
namespace {

const char* name(PartState state) {
  switch (state) {
    case PartState::held: return "held";
    case PartState::failed: return "failed";
    case PartState::skipped: return "skipped";
  }
  return "";
}

std::string figures_text(const SelfPart& part) {
  std::string text;
  for (const auto& [key, number] : part.figures.items()) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number.dump(), key);
  }
  return text;
}

}  // namespace

Json self_json(const SelfOptions& options, const SelfReport& report, double seconds) {
  Json json = {{"verdict", report.refuted()                    ? "finding"
                           : report.holds(options.require_all) ? "holds"
                                                               : "undecided"},
               {"held", report.count(PartState::held)},
               {"failed", report.count(PartState::failed)},
               {"skipped", report.count(PartState::skipped)},
               {"complete", report.complete},
               {"seed", options.seed}};
  json["parts"] = Json::array();
  Json times = Json::array();
  for (const SelfPart& part : report.parts) {
    Json about = {{"group", part.group}, {"name", part.name}, {"state", name(part.state)}, {"words", part.words}};
    Json time = {{"group", part.group}, {"name", part.name}, {"seconds", part.seconds}};
    (part.by_clock ? time : about)["figures"] = part.figures;
    json["parts"].push_back(about);
    times.push_back(time);
  }
  const int threads = options.threads > 0 ? options.threads : hardware_threads();
  json["timing"] = {{"seconds", seconds}, {"threads", threads}, {"parts", times}};
  return json;
}

report::Answer self_answer(const Json& json, const SelfReport& report, double seconds) {
  report::Answer answer(json, {"parts", "held", "failed", "skipped", "complete"});
  std::vector<TableRow> rows = {{"part", "", "result", "figures", "seconds"}};
  for (const SelfPart& part : report.parts) {
    rows.push_back({part.group, part.name, name(part.state), figures_text(part), fmt::format("{:.1f}", part.seconds)});
  }
  answer.text = table_text(rows, 4);
  const auto out = std::back_inserter(answer.text);
  for (const SelfPart& part : report.parts) {
    if (part.state == PartState::held) continue;
    fmt::format_to(out, "{}: {} {}: {}\n", name(part.state), part.group, on_one_line(part.name), part.words);
  }
  fmt::format_to(out, "Time: {:.1f} s.\n", seconds);
  return answer;
}

}  // namespace noli::audit
