// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "noli/app/commands.h"
#include "noli/app/output.h"
#include "noli/integrator/scene/explain.h"
#include "noli/integrator/scene/read_scene.h"

namespace noli::app {
namespace {

constexpr const char* footer =
    "Prints the defaults that were taken, what will be active and what is left out and why, steps, events a second, "
    "bytes\n"
    "and warnings. Nothing is simulated.\n"
    "Example:\n"
    "  noli explain scenes/swinging_cloth.json";

struct ExplainArguments {
  std::filesystem::path scene;
  bool brief = false;
};

ExitCode run(const ExplainArguments& arguments) {
  const auto form = arguments.brief ? integrator::Form::brief : integrator::Form::full;
  const integrator::Scene scene = integrator::read_scene(arguments.scene, form);
  write_standard_output(integrator::to_text(integrator::explain(scene)));
  return ExitCode::holds;
}

}  // namespace

Command add_explain(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("explain", "What a scene will do, and what it will not");
  command->footer(footer);
  const auto arguments = std::make_shared<ExplainArguments>();
  command->add_option("scene", arguments->scene, "A scene")->required()->type_name("SCENE.json");
  command->add_flag("--short", arguments->brief, "The scene's short form");
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
