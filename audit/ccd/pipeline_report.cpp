// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/pipeline_report.h"

#include <fmt/format.h>

#include <noli/errors.h>
#include "audit/ccd/audit_report.h"
#include "certify/contact_report.h"
#include "report/input_report.h"

namespace noli::audit {
namespace {

const char* verdict(const PipelineOutcome& outcome) {
  if (outcome.findings() > 0) return "finding";
  return outcome.complete ? "no_finding" : "undecided";
}

const char* ending(const PipelineAudit& audit) {
  switch (audit.ending.kind) {
    case Ending::Kind::finished: return "finished";
    case Ending::Kind::crashed: return "crash";
    case Ending::Kind::hung: return "hang";
    case Ending::Kind::too_much_memory: return "memory";
    case Ending::Kind::stopped: return "stopped";
  }
  return "";
}

Json pair_json(const std::array<std::uint64_t, 2>& numbers) {
  return {{"vertex_face", numbers[0]}, {"edge_edge", numbers[1]}};
}

Json reports_json(const PipelineAudit& audit) {
  Json json = Json::array();
  for (const PipelineFinding& finding : audit.reports) {
    json.push_back(contact_json(finding.contact));
    json.back().update({{"finding", finding.what}, {"words", finding.words}});
  }
  return json;
}

Json audit_json(const PipelineAudit& audit) {
  Json json = {{"library", audit.plugin.string()},
               {"tolerance", audit.tolerance},
               {"candidates", pair_json(audit.candidates)},
               {"not_found", audit.not_found},
               {"false_positives", pair_json(audit.false_positives)},
               {"false_negatives", audit.false_negatives},
               {"late", errors_json(audit.late)},
               {"early", errors_json(audit.early)},
               {"bad_times", audit.bad_times},
               {"failures", audit.failures},
               {"bad_pairs", audit.bad_pairs},
               {"ending", ending(audit)},
               {"words", audit.ending.words},
               {"reports", reports_json(audit)}};
  if (!audit.ending.said.empty()) json["standard_error"] = audit.ending.said;
  return json;
}

TableRow row_of(const PipelineAudit& audit) {
  return {on_one_line(audit.plugin.stem().string()),
          fmt::format("{:g}", audit.tolerance),
          std::to_string(audit.candidates[0]),
          std::to_string(audit.candidates[1]),
          std::to_string(audit.not_found),
          std::to_string(audit.false_positives[0] + audit.false_positives[1]),
          std::to_string(audit.false_negatives),
          std::to_string(audit.late.count()),
          fmt::format("{:.3g}", audit.late.worst()),
          std::to_string(audit.bad_times),
          std::to_string(audit.failures),
          std::to_string(audit.bad_pairs),
          ending(audit),
          fmt::format("{:.3g}", audit.search_seconds),
          fmt::format("{:.3g}", audit.query_seconds)};
}

void append_findings(const PipelineAudit& audit, std::string& text) {
  const std::string name = fmt::format("{}, tolerance {:g}", on_one_line(audit.plugin.string()), audit.tolerance);
  const auto& [kind, words, said] = audit.ending;
  if (!words.empty()) text += fmt::format("{}: {}: {}\n", name, ending(audit), words);
  if (!said.empty()) text += said_text(name, said);
  for (const PipelineFinding& finding : audit.reports) {
    text += fmt::format("{}: {}: {}: {}\n", name, finding.what, contact_text(finding.contact), finding.words);
  }
}

}  // namespace

report::Answer pipeline_answer(const Json& json, const PipelineOutcome& outcome) {
  report::Answer answer(json, {"audits", "contacts.vertex_face=contacts/vertex_face",
                               "contacts.edge_edge=contacts/edge_edge", "findings", "complete"});
  std::string& text = answer.text;
  text += fmt::format("{} vertices, {} edges, {} faces. Noli finds all contacts in {:.3g} s, on one thread.\n",
                      outcome.vertices, outcome.edges, outcome.faces, outcome.noli_seconds);
  std::vector<TableRow> rows = {{"library", "tolerance", "vertex-face", "edge-edge", "not-found", "false+", "false-",
                                 "late", "worst-late", "bad-times", "failures", "bad-pairs", "ending", "search-s",
                                 "queries-s"}};
  for (const PipelineAudit& audit : outcome.audits) rows.push_back(row_of(audit));
  text += table_text(rows, 1);
  for (const PipelineAudit& audit : outcome.audits) append_findings(audit, text);
  text += report::notes_text(outcome.notes);
  return answer;
}

Json pipeline_json(const PipelineOutcome& outcome) {
  Json json = {{"verdict", verdict(outcome)},
               {"findings", outcome.findings()},
               {"complete", outcome.complete},
               {"vertices", outcome.vertices},
               {"edges", outcome.edges},
               {"faces", outcome.faces},
               {"contacts", pair_json(outcome.contacts)},
               {"inputs", report::inputs_json(outcome.inputs)},
               {"notes", outcome.notes}};
  json["audits"] = Json::array();
  Json timing = {{"noli_seconds", outcome.noli_seconds}, {"audits", Json::array()}};
  for (const PipelineAudit& audit : outcome.audits) {
    json["audits"].push_back(audit_json(audit));
    timing["audits"].push_back({{"library", audit.plugin.string()},
                                {"tolerance", audit.tolerance},
                                {"search_seconds", audit.search_seconds},
                                {"query_seconds", audit.query_seconds}});
  }
  json["timing"] = timing;
  return json;
}

}  // namespace noli::audit
