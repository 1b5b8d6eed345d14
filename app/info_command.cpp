// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "report/info_report.h"

namespace noli::app {
namespace {

constexpr const char* info_footer =
    "Meshes: format, counts, extent, what is degenerate; for files with many frames (.npz, .vtkhdf), those of the "
    "first and the number of frames. Queries (CSV): how many, and how many have labels. Runs: windows, times, "
    "breakpoints, bytes, and whether the files are whole. Proofs: what they claim, steps, times, bytes.\n"
    "Examples:\n"
    "  noli info frame.ply\n"
    "  noli info frames/*.obj --json info.json\n"
    "  noli info unit-tests-edge-edge-0.csv\n"
    "  noli info runs/cloth runs/cloth/proof.blocks\n";

struct InfoArguments {
  std::vector<std::filesystem::path> files;
  std::string time_limit;
  OutputOptions results;
};

ExitCode run(const InfoArguments& arguments) {
  begin_work(arguments.time_limit);
  const Output output(arguments.results, arguments.files);
  Json json = {{"verdict", "described"}, {"files", Json::array()}};
  for (const auto& path : arguments.files) {
    if (!arguments.results.quiet) note_if_being_written(path);
    json["files"].push_back(report::file_info_json(path));
  }
  output.write("info", report::info_answer(json), json);
  return ExitCode::holds;
}

}  // namespace

Command add_info(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("info", "What is in a file or a run?");
  command->footer(info_footer);
  const auto arguments = std::make_shared<InfoArguments>();
  command->add_option("files", arguments->files, "Files of frames or of queries, proofs, or folders of runs")
      ->required()
      ->type_name("FILE");
  add_time_limit_option(*command, arguments->time_limit);
  add_output_options(*command, arguments->results);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
