// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <string>

#include "noli/app/commands.h"
#include "noli/app/export_run.h"
#include "noli/app/options.h"
#include "noli/app/output.h"

namespace noli::app {
namespace {

constexpr const char* footer =
    "Frames are samples: straight lines between them are not the certified motion, the world lines of the run are.\n"
    "Examples:\n"
    "  noli export runs/cloth --fps 60 -o frames/%05d.ply\n"
    "  noli export runs/cloth --fps 24 -o paraview/cloth_%04d.vtu    and cloth.pvd, which ParaView opens";

ExitCode run(const ExportRequest& request) {
  const ExportOutcome outcome = run_export(request);
  std::string text = fmt::format("frames {} windows {} end {} complete {}\n", outcome.frames, outcome.windows,
                                 digits17(outcome.end), !outcome.interrupted);
  if (!outcome.pvd.empty()) text += fmt::format("Series: {}\n", outcome.pvd);
  if (outcome.removed > 0) text += fmt::format("Removed: {} files of an earlier export.\n", outcome.removed);
  if (outcome.recorded)
    text += "The run recorded frames: these were written, at the scene's frame_rate, not at --fps.\n";
  if (outcome.open_window) text += "The run ends in a window that was never committed; it is left out.\n";
  text += "Straight lines between these frames are not the certified motion; the world lines of the run are.\n";
  write_standard_output(text);
  return outcome.interrupted ? ExitCode::undecided : ExitCode::holds;
}

}  // namespace

Command add_export(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("export", "Frames of a run, for other programs");
  command->footer(footer);
  const auto request = std::make_shared<ExportRequest>();
  command->add_option("run", request->run, "The folder of a run")->required()->type_name("RUN");
  command->add_option("--fps", request->fps, "Frames a second of simulated time")
      ->check(is_positive())
      ->capture_default_str();
  command->add_option("-o,--output", request->pattern, "Names of the files, e.g. frames/%05d.ply (.obj, .vtu)")
      ->required()
      ->type_name("PATTERN");
  command->add_flag("--force", request->force,
                    "Replace files of that pattern that are there, and remove those that this export does not have; "
                    "without it they are an error");
  return {command, [request] { return run(*request); }};
}

}  // namespace noli::app
