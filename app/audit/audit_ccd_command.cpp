// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/audit/library_options.h"
#include "app/commands.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "app/progress.h"
#include "audit/ccd/audit_report.h"
#include "audit/ccd/ccd_audit.h"
#include "audit/ccd/ccd_pipeline.h"
#include "audit/ccd/pipeline_report.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* audit_ccd_footer =
    "Asks libraries of continuous collision detection every query in the files and compares the answers with the exact "
    "truth: false positives, false negatives, late and early times of impact, failures, crashes, hangs, growing "
    "memory, and time per query, also as a multiple of the textbook method's.\n"
    "\n"
    "A library has two C functions, declared in noli/ccd_plugin.h, and runs in a separate process. With --frames the "
    "whole pipeline is audited: a third function searches for candidates, and all contacts between the two frames are "
    "the truth.\n"
    "\n"
    "Exit codes: 0 no finding (false positives and early times are allowed); 1 findings; 2 interrupted or "
    "out of time; 3 a library or a file is at fault.\n"
    "Examples:\n"
    "  noli audit ccd --library ./mine.so unit-tests-edge-edge-0.csv unit-tests-vertex-face-0.csv\n"
    "  noli audit ccd --library ./mine.so --library ./theirs.so --tolerance 1e-6,1e-3 q-edge-edge.csv\n"
    "  noli audit ccd --library ./mine.so queries-edge-edge.csv --svg wrong-against-time.svg\n"
    "  noli audit ccd --library ./mine.so --frames before.ply after.ply\n";

struct AuditArguments {
  audit::AuditRequest request;
  std::string query_limit = "1s";
  std::uint64_t megabytes = 2000;
  std::string time_limit;
  std::optional<std::string> svg;
  OutputOptions results;
  std::vector<fs::path> frames;
  FrameOrder order = FrameOrder::checked;
  PolygonRule polygons = PolygonRule::fan;
};

std::vector<fs::path> inputs(const AuditArguments& arguments) {
  std::vector<fs::path> all = arguments.request.files;
  all.insert(all.end(), arguments.request.libraries.begin(), arguments.request.libraries.end());
  all.insert(all.end(), arguments.frames.begin(), arguments.frames.end());
  return all;
}

ExitCode run_pipeline(const AuditArguments& arguments) {
  const audit::AuditRequest& request = arguments.request;
  if (arguments.svg) throw UsageError("--svg: cannot be combined with --frames");
  const Output output(arguments.results, inputs(arguments));
  const OrderedFrames ordered = order_frames(arguments.frames, arguments.order);
  audit::PipelineOutcome outcome =
      audit::audit_pipeline({request.libraries, ordered.frames[0], ordered.frames[1], request.tolerances,
                             request.max_reports, request.host, arguments.polygons});
  outcome.notes.insert(outcome.notes.begin(), ordered.notes.begin(), ordered.notes.end());
  const Json json = audit::pipeline_json(outcome);
  output.write("audit-pipeline", audit::pipeline_answer(json, outcome), json);
  return exit_code_of(outcome.findings() > 0, outcome.complete);
}

ExitCode run(AuditArguments& arguments) {
  audit::AuditRequest& request = arguments.request;
  settle_host(request.host, arguments.query_limit, arguments.megabytes);
  request.host.deadline = begin_work(arguments.time_limit);
  if (request.files.empty() == arguments.frames.empty()) {
    throw UsageError("expected files of queries, or --frames, and not both");
  }
  if (!arguments.frames.empty()) return run_pipeline(arguments);
  if (arguments.order != FrameOrder::checked || arguments.polygons != PolygonRule::fan) {
    throw UsageError("--order, --polygons: apply to --frames only; drop them for queries");
  }
  const Output output(arguments.results, inputs(arguments), outputs("--svg", arguments.svg));
  const audit::AuditOutcome outcome = with_progress("audit ccd", [&](const auto& show) {
    request.progress = show;
    return audit::audit_ccd(request);
  });
  output.write("audit-ccd", audit::audit_answer(outcome), audit::audit_json(outcome));
  if (arguments.svg) write_file(*arguments.svg, audit::audit_svg(outcome));
  return exit_code_of(outcome.findings() + outcome.wrong_labels() > 0, outcome.complete);
}

}  // namespace

Command add_audit_ccd(CLI::App& audit) {
  CLI::App* const command =
      audit.add_subcommand("ccd", "Compare continuous collision detection libraries with the truth");
  command->footer(audit_ccd_footer);
  const auto arguments = std::make_shared<AuditArguments>();
  audit::AuditRequest& request = arguments->request;
  command->add_option("--library", request.libraries, "A library to ask; may be given more than once")
      ->required()
      ->allow_extra_args(false)
      ->type_name("LIB.so");
  command->add_option("files", request.files, "Files of queries (CSV, as for `noli ccd`), vertex-face or edge-edge")
      ->type_name("QUERIES.csv");
  command->add_option("--frames", arguments->frames, "Instead of queries: audit a whole pipeline between two frames")
      ->expected(2)
      ->type_name("BEFORE AFTER");
  add_order_option(*command, arguments->order);
  add_polygons_option(*command, arguments->polygons);
  command
      ->add_option("--tolerance", request.tolerances,
                   "The tolerance for the libraries, a length; separate several by commas [1e-6]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(is_not_negative())
      ->type_name("T");
  command->add_option("--query-limit", arguments->query_limit, "A query that takes longer counts as hung: 500ms, 10s")
      ->capture_default_str()
      ->type_name("TIME");
  add_time_limit_option(*command, arguments->time_limit);
  command
      ->add_option("--memory-limit", arguments->megabytes,
                   "End a library's process when it uses more than this many megabytes")
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str()
      ->type_name("MB");
  command
      ->add_option("--max-hangs", request.host.most_hangs, "After this many hangs, a library skips the rest of a file")
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option("--max-reports", request.max_reports,
                   "List at most N findings for each library, tolerance and file (or step); counts are always exact")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str()
      ->type_name("N");
  add_sandbox_option(*command, request.host.sandbox);
  command->add_option("--svg", arguments->svg, "Draw wrong answers against time per query")->type_name("OUT.svg");
  add_output_options(*command, arguments->results);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
