// SPDX-License-Identifier: Apache-2.0
#include "report/ccd_report.h"

#include <fmt/format.h>

#include <iterator>
#include <string>

#include <noli/errors.h>

namespace noli::report {
namespace {

const char* ccd_verdict(const CcdOutcome& outcome) {
  if (outcome.refuted()) return "disagreement";
  if (!outcome.holds()) return "undecided";
  return outcome.total.labelled > 0 ? "agreement" : "decided";
}

void add_counts(const CcdCounts& counts, Json& json) {
  json["queries"] = counts.queries;
  json["contacts"] = counts.contacts;
  json["labelled"] = counts.labelled;
  json["disagreements"] = counts.disagreements;
  json["stages"] = stages_json(counts.stages);
}

Json file_json(const CcdFile& file, const CcdRequest& request) {
  Json json = {{"file", file.path.string()}, {"kind", name(file.pair)}};
  add_counts(file.counts, json);
  json["disagreement_reports"] = Json::array();
  for (const auto& [query, label] : file.disagreements) {
    json["disagreement_reports"].push_back({{"query", query}, {"label", label ? 1 : 0}, {"contact", !label}});
  }
  if (!request.times) return json;
  json["times"] = Json::array();
  for (const auto& [query, kind, time] : file.times) {
    json["times"].push_back({{"query", query}, {"kind", name(kind)}, {"time", time}});
  }
  return json;
}

Json timing_json(const CcdOutcome& outcome) {
  Json files = Json::array();
  for (const CcdFile& file : outcome.files) {
    files.push_back({{"file", file.path.string()}, {"ns_per_query", file.counts.ns_per_query}});
  }
  return {{"ns_per_query", outcome.total.ns_per_query}, {"files", files}};
}

std::string counts_text(const CcdCounts& counts) {
  return fmt::format("queries {} contacts {} labelled {} disagreements {}", counts.queries, counts.contacts,
                     counts.labelled, counts.disagreements);
}

void append_file(const CcdFile& file, std::string& text) {
  const auto out = std::back_inserter(text);
  const std::string path = on_one_line(file.path.string());
  fmt::format_to(out, "{}: {}, {}, {:.1f} ns a query\n", path, name(file.pair), counts_text(file.counts),
                 file.counts.ns_per_query);
  for (const auto& [query, label] : file.disagreements) {
    fmt::format_to(out, "{}: query {}: labelled {}, but {}\n", path, query, label ? 1 : 0,
                   label ? "apart" : "in contact");
  }
  const auto left_out = file.counts.disagreements - file.disagreements.size();
  if (left_out > 0) fmt::format_to(out, "{}: and {} more disagreements (--max-reports)\n", path, left_out);
  for (const auto& [query, kind, time] : file.times) {
    fmt::format_to(out, "{}: query {}: {} at {}\n", path, query, name(kind), digits17(time));
  }
}

}  // namespace

Json ccd_json(const CcdRequest& request, const CcdOutcome& outcome) {
  Json json = {{"verdict", ccd_verdict(outcome)}, {"complete", outcome.complete}, {"dimension", request.dimension}};
  add_counts(outcome.total, json);
  json["files"] = Json::array();
  for (const CcdFile& file : outcome.files) json["files"].push_back(file_json(file, request));
  json["timing"] = timing_json(outcome);
  return json;
}

Answer ccd_answer(const Json& json, const CcdOutcome& outcome) {
  const CcdCounts& total = outcome.total;
  Answer answer(json, {"queries", "contacts", "labelled", "disagreements", "complete"});
  for (const CcdFile& file : outcome.files) append_file(file, answer.text);
  answer.details = "Stages:";
  for (const Stage stage : all_stages) answer.details += fmt::format(" {} {}", name(stage), total.stages[stage]);
  answer.details += fmt::format("\nTime: {:.1f} ns a query.\n", total.ns_per_query);
  return answer;
}

}  // namespace noli::report
