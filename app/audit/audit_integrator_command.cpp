// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/numerics/integrator_report.h"
#include "integrator/scene/read_scene.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* integrator_footer =
    "Runs each scene by several methods with longer and shorter steps: this integrator, with a step for each "
    "force and with steps in groups; Verlet's method, with one step for all; implicit Euler, for context. It "
    "reports the errors of trajectory, energy and momentum at the ends of windows, against a reference with "
    "much shorter steps, and the time of each run.\n"
    "\n"
    "Exit codes: 0 measured; 1 the values of a run became infinite or NaN; 2 interrupted.\n"
    "Examples:\n"
    "  noli audit integrator --svg integrator.svg\n"
    "  noli audit integrator scenes/stiff_inset.json --short --windows 5 --json result.json\n";

struct IntegratorArguments {
  audit::IntegratorOptions options;
  std::vector<fs::path> scenes;
  bool brief = false;
  std::optional<std::string> svg;
  OutputOptions results;
};

std::vector<integrator::Scene> scenes_of(const IntegratorArguments& arguments) {
  std::vector<integrator::Scene> scenes;
  const auto form = arguments.brief ? integrator::Form::brief : integrator::Form::full;
  for (const fs::path& file : arguments.scenes) {
    scenes.push_back(integrator::read_scene(file, form));
    if (arguments.brief && !has_short_form(scenes.back())) note_missing_short_form();
  }
  if (!scenes.empty()) return scenes;
  for (const std::string& text : audit::integrator_scenes()) {
    scenes.push_back(integrator::parse_scene(text, "built in"));
  }
  return scenes;
}

ExitCode run(IntegratorArguments& arguments) {
  audit::IntegratorOptions& options = arguments.options;
  options.stop = &interrupted();
  const Output output(arguments.results, arguments.scenes, outputs("--svg", arguments.svg));
  audit::IntegratorResults results;
  for (const integrator::Scene& scene : scenes_of(arguments)) {
    options.begun = [&](const std::string& method, double factor) {
      std::fputs(fmt::format("noli: {}: {}, steps times {:g}\n", on_one_line(scene.title), method, factor).c_str(),
                 stderr);
    };
    results.push_back(audit::audit_integrator(scene, options));
    if (!results.back().complete) break;
  }
  output.write("audit-integrator", audit::integrator_answer(results), audit::integrator_json(results));
  if (arguments.svg) write_file(*arguments.svg, audit::integrator_svg(results));
  const std::string_view verdict = audit::integrator_verdict(results);
  return exit_code_of(verdict == "finding", verdict == "measured");
}

}  // namespace

Command add_audit_integrator(CLI::App& audit) {
  CLI::App* const command =
      audit.add_subcommand("integrator", "Error against run time, compared with the usual methods");
  command->footer(integrator_footer);
  const auto arguments = std::make_shared<IntegratorArguments>();
  audit::IntegratorOptions& options = arguments->options;
  command->add_option("scenes", arguments->scenes, "Scenes to run; default: a uniform sheet and a graded one")
      ->type_name("SCENE.json");
  command->add_flag("--short", arguments->brief, "The scenes' short forms");
  command->add_option("--halvings", options.halvings, "How many times steps are halved")
      ->check(whole_number(0, 20))
      ->capture_default_str()
      ->type_name("N");
  command->add_option("--windows", options.windows, "How many windows of each scene to run, at most all of them")
      ->check(whole_number(1, 1'000'000))
      ->capture_default_str()
      ->type_name("N");
  command->add_flag_callback(
      "--no-euler", [&options] { options.euler = false; }, "Skip the implicit Euler method");
  command->add_option("--svg", arguments->svg, "Draw errors against run time")->type_name("OUT.svg");
  add_output_options(*command, arguments->results);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
