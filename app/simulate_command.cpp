// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <memory>
#include <string>

#include <noli/simulate.h>
#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "app/progress.h"
#include "report/simulate_report.h"

namespace noli::app {
namespace {

ExitCode exit_code(const SimulateOutcome& outcome) {
  switch (outcome.end) {
    case RunEnd::done: return ExitCode::holds;
    case RunEnd::contact:
    case RunEnd::too_near:
    case RunEnd::not_finite:
    case RunEnd::unstable: return ExitCode::refuted;
    case RunEnd::interrupted:
    case RunEnd::out_of_time:
    case RunEnd::out_of_memory: return ExitCode::undecided;
  }
  return ExitCode::failure;
}

constexpr const char* simulate_footer =
    "Each window of simulated time is verified exactly before it is committed, so a run never contains a contact. At "
    "the first one, the run ends and reports the features, the kind and the exact time; earlier windows stay.\n"
    "\n"
    "An interrupted run (Ctrl-C) continues with --resume, and ends with the same bytes. A run that was stopped while "
    "building its model has no folder yet: start it again. The predicted size is printed before a run begins; too "
    "little space on the disk is an error (exit 4). Windows count from 1.\n"
    "\n"
    "Verdicts: no_contact (exit 0); contact, too_near (a pair needs more layers of contact than allowed), "
    "not_finite (numbers overflow), unstable (all windows are there, but the energy is off by more than a "
    "twentieth) (1); undecided (interrupted, out of time or memory: 2).\n"
    "Examples:\n"
    "  noli simulate scenes/swinging_cloth.json -o runs/cloth\n"
    "  noli simulate scenes/swinging_cloth.json --short -o runs/short\n"
    "  noli simulate scene.json -o run --resume\n"
    "  noli simulate scene.json -o run --until 2.5 --json result.json\n"
    "  noli simulate scene.json -o run --until 20 --past-duration --resume\n"
    "  noli simulate scene.json --reproduce run --window 3 -o window3.block\n";

struct SimulateArguments {
  SimulateRequest request;
  std::optional<std::string> reproduce;
  std::uint64_t window = 1;
  std::string time_limit;
  OutputOptions results;
};

/// Makes one window of a run again.
ExitCode reproduce(const SimulateArguments& arguments) {
  const SimulateRequest& request = arguments.request;
  const Output output(arguments.results, {request.scene, *arguments.reproduce}, {{"-o", request.run}});
  const ReproduceRequest again{request.scene, request.brief, *arguments.reproduce, arguments.window, request.run};
  const ReproduceOutcome outcome = run_reproduce(again);
  const Json json = report::reproduce_json(again, outcome);
  output.write("reproduce", report::reproduce_answer(json, again), json);
  return outcome.same ? ExitCode::holds : ExitCode::refuted;
}

ExitCode run(SimulateArguments& arguments) {
  SimulateRequest& request = arguments.request;
  request.deadline = begin_work(arguments.time_limit);
  if (arguments.reproduce) return reproduce(arguments);
  auto inputs = inputs_of_scene(request.scene);
  inputs.push_back(request.run);
  const Output output(arguments.results, inputs);
  request.force = arguments.results.force;
  request.begins = [&arguments, &request](const SimulateStart& start) {
    if (arguments.results.quiet) return;
    if (request.brief && !start.has_short_form) note_missing_short_form();
    tell_notes(start.notes);
    tell_note(start.space);
  };
  request.stop = &interrupted();
  request.stops = interruptions;
  std::optional<ProgressBars> bars(std::in_place);
  request.progress = [&bars](std::string_view work, double share) { bars->show(work, share); };
  const SimulateOutcome outcome = run_simulate(request);
  bars.reset();
  const Json json = report::simulate_json(request, outcome);
  output.write("simulate", report::simulate_answer(json, request, outcome), json);
  return exit_code(outcome);
}

}  // namespace

Command add_simulate(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("simulate", "Run a scene, certified window by window");
  command->footer(simulate_footer);
  const auto arguments = std::make_shared<SimulateArguments>();
  SimulateRequest& request = arguments->request;
  command->add_option("scene", request.scene, "A scene (`noli schema scene` says what can be in it)")
      ->required()
      ->type_name("SCENE.json");
  command->add_option("-o,--output", request.run, "The folder of the run (with --reproduce, a file)")
      ->required()
      ->type_name("RUN");
  command->add_flag("--short", request.brief, "The scene's short form");
  auto* const resume = command->add_flag("--resume", request.resume, "Continue the run in the folder");
  command
      ->add_flag_callback(
          "--no-proof", [&request] { request.prove = false; },
          "Write no proofs of the windows (there are some only with \"record\": \"full\")")
      ->excludes(resume);
  auto* const until =
      command->add_option("--until", request.until, "Simulated time to stop at; default: the scene's duration")
          ->check(is_positive())
          ->type_name("SECONDS");
  command->add_flag("--past-duration", request.past_duration, "--until may lie beyond the scene's duration")
      ->needs(until);
  command->add_flag("--ignore-space", request.ignore_space,
                    "Begin even if the predicted run is larger than the free space on the disk");
  auto* const again = command
                          ->add_option("--reproduce", arguments->reproduce,
                                       "Integrate one window of this run again and write its block to the file -o")
                          ->type_name("RUN")
                          ->excludes(resume)
                          ->excludes(until);
  command->add_option("--window", arguments->window, "Which window, counted from 1")
      ->check(whole_number(1, std::numeric_limits<std::uint64_t>::max()))
      ->needs(again)
      ->type_name("K");
  add_time_limit_option(*command, arguments->time_limit,
                        "Stop after this time: 500ms, 60s, 5m, 1h; an unfinished window is dropped. Writing series.h5 "
                        "takes extra time; Ctrl-C ends that too");
  add_output_options(*command, arguments->results);
  command->get_option("--force")->description(
      "Replace the run in the folder (not with --resume), and existing outputs");
  add_threads_option(*command, request.threads);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
