// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>

#include <noli/errors.h>
#include <noli/repair.h>
#include "app/bodies.h"
#include "app/commands.h"
#include "app/help.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "app/progress.h"
#include "certify/frame_files.h"
#include "certify/repair/moving_vertices.h"
#include "certify/repair/repaired_frames.h"
#include "report/repair_report.h"
#include "trajectory/formats/frame_names.h"

namespace noli::app {
namespace {

constexpr const char* repair_footer =
    "Writes another motion near the given one, in which nothing touches. A step that touches nothing stays as it is; "
    "in all others, the vertices are masses that only contact stops. Where straight lines between the frames would "
    "still touch, frames are inserted; times.csv lists their times. Everything that is written has been decided "
    "exactly, and the last line is noli verify's verdict:\n"
    "  proved      the checker accepted the proof: nothing touches            exit 0\n"
    "  no_contact  decided exactly, not checked (--no-check)                  exit 0\n"
    "  cannot_be   the first frame touches, or fixed vertices meet            exit 1\n"
    "  undecided   a limit was reached, or no way was found                   exit 2\n"
    "Examples:\n"
    "  noli repair 'cloth_*.obj' -o mended/cloth_%03d.obj\n"
    "  noli repair frames -o mended/%04d.ply --proof mended.noli\n"
    "  noli repair frames -o mended/%04d.ply --run mended.run    also the motion between the new frames\n"
    "  noli repair start.obj target.obj -o out/%03d.obj --fixed-first 835    these move as given\n"
    "  noli repair --body shirt='shirt_*.obj' --body man='man_*.obj' --fixed man -o out/%03d.ply\n";

struct RepairArguments {
  RepairRequest request;
  BodyArguments bodies;
  std::optional<std::filesystem::path> fixed_vertices;
  std::string time_limit;
  OutputOptions results;
};

ExitCode exit_code(const RepairOutcome& outcome) {
  const std::string_view verdict = report::repair_verdict(outcome);
  if (verdict == "cannot_be") return ExitCode::refuted;
  return verdict == "undecided" ? ExitCode::undecided : ExitCode::holds;
}

/// Beside the results. The frames, and with --resume what stands beside them, are the business of run_repair().
std::vector<OutputFile> outputs_of(const RepairArguments& arguments) {
  const RepairRequest& request = arguments.request;
  std::vector<OutputFile> files;
  if (request.proof) {
    if (*request.proof == "-") throw UsageError("--proof -: a proof is not text; expected the name of a file");
    files.push_back({"--proof", *request.proof, true});
  }
  for (const auto& [option, path] : {std::pair("--json", arguments.results.json.value_or("-")),
                                     std::pair("--proof", request.proof ? request.proof->string() : "-")}) {
    if (path == "-" || !is_of_repaired(path, request.pattern)) continue;
    throw UsageError(
        fmt::format("{} {}: is a frame of -o, or written next to them; expected another name", option, path));
  }
  return files;
}

/// New frames would be read as given ones by the next call.
void require_no_folder_read(const RepairRequest& request) {
  std::error_code error;
  const std::filesystem::path folder = parse_pattern(request.pattern).folder();
  for (const auto& given : request.frames) {
    if (!std::filesystem::is_directory(given, error)) continue;
    if (!std::filesystem::equivalent(given, folder.empty() ? "." : folder, error)) continue;
    throw UsageError("-o " + request.pattern + ": " + given.string() + " is read; choose another folder");
  }
}

ExitCode run(RepairArguments& arguments) {
  RepairRequest& request = arguments.request;
  request.deadline = begin_work(arguments.time_limit);
  auto inputs = files_named(request.frames);
  std::vector<std::string> notes;
  if (arguments.bodies.any()) {
    request.reading.bodies = bodies_of(arguments.bodies, request.order, notes);
    request.frames = files_of(request.reading.bodies);
  } else {
    if (request.frames.empty()) {
      throw UsageError("`noli repair` needs FRAMES or bodies (--body); see `noli repair --help`");
    }
    require_no_folder_read(request);
    request.frames = named_frames(std::move(request.frames));
  }
  if (request.run && request.run->empty()) throw UsageError("--run: expected the name of a folder, found ''");
  if (request.run) inputs.push_back(*request.run);  // no output is one of its files
  if (arguments.fixed_vertices) {
    request.fixed_listed = listed_vertices(*arguments.fixed_vertices);
    request.fixed_file = arguments.fixed_vertices;
  }
  std::ranges::copy(files_read(request), std::back_inserter(inputs));
  const Output output(arguments.results, inputs, outputs_of(arguments));
  request.force = arguments.results.force && !request.resume;
  request.stop = &interrupted();
  std::optional<ProgressBars> bars(std::in_place);
  request.progress = [&](std::string_view work, double share) { bars->show(work, share, ""); };
  RepairOutcome outcome = run_repair(request);
  bars.reset();
  outcome.notes.insert(outcome.notes.begin(), notes.begin(), notes.end());
  output.write("repair", report::repair_answer(request, outcome), report::repair_json(request, outcome));
  return exit_code(outcome);
}

}  // namespace

Command add_repair(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("repair", "Write a motion near this one in which nothing touches");
  command->footer(repair_footer);
  const auto arguments = std::make_shared<RepairArguments>();
  RepairRequest& request = arguments->request;
  CLI::Option* const frames =
      command->add_option("frames", request.frames, "Frames in the order of time: files, a folder, a pattern")
          ->type_name("FRAMES");
  add_body_options(*command, arguments->bodies, frames);
  command->add_option("--fixed", request.fixed_bodies, "Bodies that move as given, by name; obstacles always do")
      ->allow_extra_args(false)
      ->type_name("NAME");
  command->add_option("-o,--output", request.pattern, "Names of the new frames: out/%04d.ply, .obj or .vtu")
      ->required()
      ->type_name("PATTERN");
  command->add_option("--fixed-first", request.fixed_first, "The first N vertices move as given")
      ->check(whole_number(0, 1'000'000'000))
      ->type_name("N");
  command
      ->add_option("--fixed-vertices", arguments->fixed_vertices,
                   "Vertices that move as given, a text file with their numbers from 0")
      ->type_name("FILE");
  command->add_flag("--resume", request.resume, "Continue a stopped repair after its last complete step");
  add_order_option(*command, request.order);
  command
      ->add_option("--thickness", request.thickness,
                   "The gap to aim at; default: a quarter of the smallest cell height")
      ->check(is_positive())
      ->type_name("DISTANCE");
  command
      ->add_option("--run", request.run,
                   "Also keep the motion as contact made it: a run, in which a step is a window of one second")
      ->type_name("RUN");
  command->add_option("--proof", request.proof, "Write the proof about the new frames to this file")->type_name("OUT");
  command->add_flag_callback(
      "--no-check", [&request] { request.check = false; },
      "Skip the checker: the verdict is then no_contact, not proved");
  add_output_options(*command, arguments->results);
  add_threads_option(*command, request.threads);
  add_time_limit_option(*command, arguments->time_limit);
  command->add_option("--restitution", request.restitution, "Share of the approach energy that comes back")
      ->check(is_share())
      ->capture_default_str()
      ->type_name("E")
      ->group(group::question);
  command
      ->add_option("--masses", request.masses,
                   "Masses of vertices: size (by area and length), uniform, or a text file with one number each")
      ->capture_default_str()
      ->type_name("size|uniform|FILE")
      ->group(group::question);
  command->add_option("--friction", request.friction, "Coulomb's coefficient")
      ->check(is_not_negative())
      ->capture_default_str()
      ->type_name("MU")
      ->group(group::question);
  command
      ->add_option("--spread", request.spread,
                   "Contact also moves the surroundings, over about this many edges; 0: only what touches")
      ->check(whole_number(0, 100))
      ->capture_default_str()
      ->type_name("EDGES")
      ->group(group::question);
  command
      ->add_option("--ignore", request.ignore,
                   "Groups of vertices that may pass through each other, a JSON file as for noli verify")
      ->type_name("GROUPS.json")
      ->group(group::question);
  command
      ->add_flag("--only-new", request.only_new,
                 "Cells that intersect in the first frame are not compared: they may stay so")
      ->group(group::question);
  command
      ->add_flag("--points", request.points,
                 "Treat vertices without a face or edge as particles; else they are ignored")
      ->group(group::question);
  command
      ->add_option("--dimension", request.dimension,
                   "2 ignores z. Default: 2 if all z of the first two frames are equal, else 3")
      ->check(is_dimension())
      ->type_name("2|3")
      ->group(group::question);
  add_polygons_option(*command, request.reading.polygons);
  add_keys_option(*command, request.reading.keys);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
