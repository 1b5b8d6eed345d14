// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "certify/run_explanation.h"
#include "certify/runs/run_folder.h"
#include "certify/simulate/start_check.h"
#include "integrator/scene/explain.h"
#include "integrator/scene/read_scene.h"
#include "report/run_explanation_report.h"

namespace noli::app {
namespace {

constexpr const char* explain_footer =
    "Of a scene: the defaults taken, what will be active, what is left out and why, steps, events a second, "
    "bytes, warnings. Nothing is simulated.\n"
    "\n"
    "Of a run, from its files: how deep the layers of contact went, how near things came (exactly, where "
    "world lines were recorded), events, certificates, where the time went, windows that were rolled back, "
    "energy.\n"
    "Examples:\n"
    "  noli explain scenes/swinging_cloth.json\n"
    "  noli explain scenes/stiff_inset.json --short --json -\n"
    "  noli explain runs/curtains\n";

struct ExplainArguments {
  std::filesystem::path scene;
  bool brief = false;
  std::string time_limit;
  OutputOptions results;
};

ExitCode explain_folder(const ExplainArguments& arguments) {
  if (arguments.brief) throw UsageError("--short: applies to scenes only; drop it for a run");
  const Output output(arguments.results, {arguments.scene});
  if (!arguments.results.quiet) note_if_being_written(arguments.scene);
  const RunExplanation explanation = explain_run(arguments.scene);
  const Json json = report::to_json(explanation);
  output.write("explain-run", report::answer_of(json, explanation), json);
  return ExitCode::holds;
}

ExitCode run(const ExplainArguments& arguments) {
  const auto deadline = begin_work(arguments.time_limit);
  if (std::filesystem::is_directory(arguments.scene)) return explain_folder(arguments);
  const auto form = arguments.brief ? integrator::Form::brief : integrator::Form::full;
  const Output output(arguments.results, inputs_of_scene(arguments.scene));
  const integrator::Scene scene = integrator::read_scene(arguments.scene, form);
  integrator::Explanation explanation = integrator::explain(scene);
  const std::string met = contact_at_start(scene, &interrupted(), deadline);
  if (!met.empty())
    explanation.warnings.push_back("the scene begins in contact, and `noli simulate` will refuse it: " + met);
  if (arguments.brief && !has_short_form(scene)) note_missing_short_form();
  report::Answer answer("explained", {{"title", explanation.title}, {"dimension", explanation.dimension}});
  answer.text = integrator::to_text(explanation);
  output.write("explain-scene", answer, integrator::to_json(explanation));
  return ExitCode::holds;
}

}  // namespace

Command add_explain(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("explain", "What will a scene do? How did a run go?");
  command->footer(explain_footer);
  const auto arguments = std::make_shared<ExplainArguments>();
  command->add_option("scene", arguments->scene, "A scene, or the folder of a run")
      ->required()
      ->type_name("SCENE.json|RUN");
  command->add_flag("--short", arguments->brief, "The scene's short form");
  add_time_limit_option(*command, arguments->time_limit);
  add_output_options(*command, arguments->results);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
