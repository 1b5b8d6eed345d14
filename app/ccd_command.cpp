// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>
#include <map>
#include <memory>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "app/progress.h"
#include "certify/queries/ccd_run.h"

namespace noli::app {
namespace {

constexpr const char* ccd_footer =
    "Each query is decided exactly. Where a file has labels, a last column of 0 or 1, they are compared with "
    "the answers; exit 1 when one disagrees.\n"
    "\n"
    "A row is a point: x numerator, x denominator, y .., z .. [, label]. A query is its points at t = 0, "
    "then at t = 1. Lines that begin with # are skipped.\n"
    "Examples:\n"
    "  noli ccd unit-tests-edge-edge-0.csv unit-tests-vertex-face-0.csv\n"
    "  noli ccd queries.csv --kind vertex-face --json result.json\n"
    "  noli ccd drawing-vertex-edge.csv --dimension 2 --times\n";

const std::map<std::string, FeaturePair> kinds = {{"vertex-face", FeaturePair::vertex_face},
                                                  {"edge-edge", FeaturePair::edge_edge},
                                                  {"vertex-edge", FeaturePair::vertex_edge},
                                                  {"vertex-vertex", FeaturePair::vertex_vertex}};

struct CcdArguments {
  std::string time_limit;
  CcdRequest request;
  std::string kind;
  OutputOptions results;
};

const char* verdict(const CcdOutcome& outcome) {
  if (outcome.total.disagreements > 0) return "disagreement";
  if (!outcome.complete) return "undecided";
  return outcome.total.labelled > 0 ? "agreement" : "decided";
}

ExitCode exit_code(const CcdOutcome& outcome) {
  if (outcome.total.disagreements > 0) return ExitCode::refuted;
  return outcome.complete ? ExitCode::holds : ExitCode::undecided;
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

Json ccd_json(const CcdRequest& request, const CcdOutcome& outcome) {
  Json json = {{"verdict", verdict(outcome)}, {"complete", outcome.complete}, {"dimension", request.dimension}};
  add_counts(outcome.total, json);
  json["files"] = Json::array();
  for (const CcdFile& file : outcome.files) json["files"].push_back(file_json(file, request));
  json["timing"] = timing_json(outcome);
  return json;
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

report::Answer ccd_answer(const Json& json, const CcdOutcome& outcome) {
  const CcdCounts& total = outcome.total;
  report::Answer answer(json, {"queries", "contacts", "labelled", "disagreements", "complete"});
  for (const CcdFile& file : outcome.files) append_file(file, answer.text);
  answer.details = "Stages:";
  for (const Stage stage : all_stages) answer.details += fmt::format(" {} {}", name(stage), total.stages[stage]);
  answer.details += fmt::format("\nTime: {:.1f} ns a query.\n", total.ns_per_query);
  return answer;
}

ExitCode run(CcdArguments& arguments) {
  begin_work(arguments.time_limit);
  CcdRequest& request = arguments.request;
  if (!arguments.kind.empty()) request.pair = kinds.at(arguments.kind);
  const Output output(arguments.results, request.files);
  request.stop = &interrupted();
  const CcdOutcome outcome = with_progress("ccd", [&](const auto& show) {
    request.progress = show;
    return run_ccd(request);
  });
  const Json json = ccd_json(request, outcome);
  output.write("ccd", ccd_answer(json, outcome), json);
  return exit_code(outcome);
}

}  // namespace

Command add_ccd(CLI::App& app) {
  CLI::App* const command =
      app.add_subcommand("ccd", "Decide single queries from files, and compare with their labels");
  command->footer(ccd_footer);
  const auto arguments = std::make_shared<CcdArguments>();
  CcdRequest& request = arguments->request;
  command->add_option("files", request.files, "Files of queries (CSV)")->required()->type_name("QUERIES.csv");
  command
      ->add_option("--kind", arguments->kind,
                   "vertex-face, edge-edge, vertex-edge or vertex-vertex; by default the file name says which")
      ->check(CLI::IsMember({"vertex-face", "edge-edge", "vertex-edge", "vertex-vertex"}))
      ->type_name("KIND");
  command->add_option("--dimension", request.dimension, "2 ignores z")->check(is_dimension())->type_name("2|3");
  command->add_flag("--times", request.times, "Print kind and time of every contact (17 digits, rounded down)");
  command
      ->add_option("--max-reports", request.max_reports,
                   "List at most N disagreements per file; counts are always exact")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str()
      ->type_name("N");
  add_output_options(*command, arguments->results);
  add_time_limit_option(*command, arguments->time_limit);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
