// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "app/progress.h"
#include "audit/numerics/precision.h"
#include "audit/numerics/precision_report.h"
#include "certify/simulate/run_extent.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* precision_footer =
    "Runs a scene in double and, event by event in the same order, in MPFR numbers of other precisions. It reports how "
    "far positions, energies and momenta drift apart, when the order of events would differ, and how much of the "
    "energy error is rounding and how much is truncation. A run with 53 bits and the exponents of double is always "
    "included; it must give the same bits as double.\n"
    "\n"
    "Exit codes: 0 they do (same); 1 they do not (differs); 2 not all windows were run (undecided).\n"
    "Examples:\n"
    "  noli audit precision scenes/bounce.json --until 2\n"
    "  noli audit precision scenes/swinging_cloth.json --short --bits 53,256 --svg cloth.svg\n";

struct PrecisionArguments {
  audit::PrecisionRequest request;
  fs::path scene;
  bool brief = false;
  std::optional<double> until;
  bool past_duration = false;
  std::vector<int> bits = {53, 64, 113, 256};
  std::string time_limit;
  std::optional<std::string> svg;
  OutputOptions results;
};

constexpr int least_bits = 24;

/// Double first, then the others by precision.
std::vector<audit::Arithmetic> arithmetics(std::vector<int> bits) {
  std::sort(bits.begin(), bits.end());
  bits.erase(std::unique(bits.begin(), bits.end()), bits.end());
  std::vector<audit::Arithmetic> result = {audit::hardware_double};
  for (const int b : bits) {
    if (b != audit::hardware_double.bits) result.push_back({b, false});
  }
  if (bits.back() <= audit::hardware_double.bits) {
    throw UsageError("--bits: expected at least one precision above 53, to compare double with");
  }
  return result;
}

audit::PrecisionOutcome audit_scene(const integrator::Scene& scene, const audit::PrecisionRequest& request) {
  if (scene.dimension == 2) return audit::audit_precision(integrator::build_model<2>(scene).model, request);
  return audit::audit_precision(integrator::build_model<3>(scene).model, request);
}

ExitCode run(PrecisionArguments& arguments) {
  audit::PrecisionRequest& request = arguments.request;
  request.arithmetics = arithmetics(arguments.bits);
  request.stop = &interrupted();
  request.deadline = begin_work(arguments.time_limit);
  const Output output(arguments.results, {arguments.scene}, outputs("--svg", arguments.svg));
  const auto form = arguments.brief ? integrator::Form::brief : integrator::Form::full;
  const integrator::Scene scene = integrator::read_scene(arguments.scene, form);
  if (arguments.brief && !has_short_form(scene)) note_missing_short_form();
  SimulateRequest extent;
  extent.scene = arguments.scene;
  extent.until = arguments.until;
  extent.past_duration = arguments.past_duration;
  request.windows = windows_of(extent, scene);
  const Stopwatch watch;
  const audit::PrecisionOutcome outcome = with_progress("audit precision", [&](const auto& show) {
    request.progress = show;
    return audit_scene(scene, request);
  });
  Json json = audit::precision_json(outcome);
  json["timing"] = {{"seconds", watch.seconds()}, {"threads", request.threads}};
  output.write("audit-precision", audit::precision_answer(outcome), json);
  if (arguments.svg) write_file(*arguments.svg, audit::precision_svg(outcome, scene.title));
  return exit_code_of(outcome.difference.has_value(), outcome.complete && outcome.windows > 0);
}

}  // namespace

Command add_audit_precision(CLI::App& audit) {
  CLI::App* const command = audit.add_subcommand("precision", "How far does double precision carry a scene?");
  command->footer(precision_footer);
  const auto arguments = std::make_shared<PrecisionArguments>();
  command->add_option("scene", arguments->scene, "A scene, as for `noli simulate`")
      ->required()
      ->type_name("SCENE.json");
  command->add_flag("--short", arguments->brief, "The scene's short form");
  auto* const until =
      command->add_option("--until", arguments->until, "Simulated time to stop at; default: the scene's duration")
          ->check(is_positive())
          ->type_name("SECONDS");
  command->add_flag("--past-duration", arguments->past_duration, "--until may lie beyond the scene's duration")
      ->needs(until);
  command
      ->add_option("--bits", arguments->bits,
                   "Precisions to run, separated by commas [53,64,113,256]; energies are compared with the highest")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(whole_number(least_bits, audit::MpfrNumber::most_bits))
      ->type_name("P,...");
  command->add_option("--svg", arguments->svg, "Draw drifts and energy errors over time")->type_name("OUT.svg");
  add_time_limit_option(*command, arguments->time_limit,
                        "Stop after this time: 500ms, 60s, 5m, 1h; an unfinished window is dropped");
  add_output_options(*command, arguments->results);
  add_threads_option(*command, arguments->request.threads);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
