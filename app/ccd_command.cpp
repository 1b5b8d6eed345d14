// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "app/progress.h"
#include "certify/queries/ccd_run.h"
#include "report/ccd_report.h"

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
  const Json json = report::ccd_json(request, outcome);
  output.write("ccd", report::ccd_answer(json, outcome), json);
  return exit_code_of(outcome.refuted(), outcome.holds());
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
