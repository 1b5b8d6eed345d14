// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <string>

#include "noli/app/commands.h"
#include "noli/app/options.h"
#include "noli/app/output.h"
#include "noli/integrator/scene/explain.h"
#include "noli/integrator/scene/read_scene.h"

namespace noli::app {
namespace {

constexpr const char* footer =
    "Prints the defaults that were taken, what will be active and what is left out and why, steps, events a second, "
    "bytes and warnings. Nothing is simulated.\n"
    "Examples:\n"
    "  noli explain scenes/swinging_cloth.json\n"
    "  noli explain scenes/stiff_inset.json --short --json -";

struct ExplainArguments {
  std::filesystem::path scene;
  bool brief = false;
  std::optional<std::string> json;
};

ExitCode run(const ExplainArguments& arguments) {
  const auto form = arguments.brief ? integrator::Form::brief : integrator::Form::full;
  const Output output(arguments.json, {arguments.scene});
  const integrator::Explanation explanation = integrator::explain(integrator::read_scene(arguments.scene, form));
  output.write(integrator::to_text(explanation), integrator::to_json(explanation));
  return ExitCode::holds;
}

}  // namespace

Command add_explain(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("explain", "What a scene will do, and what it will not");
  command->footer(footer);
  const auto arguments = std::make_shared<ExplainArguments>();
  command->add_option("scene", arguments->scene, "A scene")->required()->type_name("SCENE.json");
  command->add_flag("--short", arguments->brief, "The scene's short form");
  add_json_option(*command, arguments->json);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
