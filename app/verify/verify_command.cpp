// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include <noli/verify.h>
#include "app/bodies.h"
#include "app/commands.h"
#include "app/help.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "app/progress.h"
#include "app/verify/verdict.h"
#include "app/verify/verify_shards.h"
#include "certify/proofs/proof_route.h"
#include "report/meshes_report.h"
#include "report/verify_report.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/frame_names.h"

namespace noli::app {
namespace {

constexpr const char* verify_footer =
    "Decides each step from one frame to the next exactly: every vertex moves along a straight line, and "
    "coordinates are taken as they are. A separate checker then checks the proof. The last line is the "
    "verdict:\n"
    "  proved      the checker accepted the proof: nothing touches            exit 0\n"
    "  no_contact  decided exactly, not checked (--no-check, or see note)     exit 0\n"
    "  contact     something touches; the line names step, time and features  exit 1\n"
    "  too_near    with --min-distance: something comes nearer than that      exit 1\n"
    "  undecided   a limit was reached, or the work was interrupted           exit 2\n"
    "Steps count from 1; of a run they are its windows. Times are in [0, 1] of their step, in seconds for a "
    "run.\n"
    "Examples:\n"
    "  noli verify before.ply after.ply\n"
    "  noli verify 'cloth_*.obj'                     in quotes: cloth_2 before cloth_10\n"
    "  noli verify frames --json result.json         all frames in a folder\n"
    "  noli verify motion.npz --keys vertices,faces  arrays (frames, vertices, 3) and (faces, 3)\n"
    "  noli verify --body shirt='shirt_*.obj' --body man='man_*.obj' --obstacle floor.obj\n"
    "  noli verify frames/%04d.ply                   or @list.txt, which names the files\n"
    "  noli verify a.ply b.ply --proof ab.noli       anybody can check it: noli check ab.noli a.ply b.ply\n"
    "  noli verify rest.ply --static                 does this mesh intersect itself?\n"
    "  noli verify a.ply b.ply --json - | jq .first\n"
    "  noli verify frames/*.ply --junit noli.xml     for continuous integration\n"
    "  noli verify runs/cloth                        a run of `noli simulate`, from its files alone\n"
    "  noli verify runs/cloth --follow               the same while it is being written\n"
    "  noli verify runs/cloth --shard 3/64 -o shards one of 64 parts; then noli merge shards\n"
    "  noli verify runs/ring --reproduce             a run that recorded frames only\n";

struct VerifyArguments {
  VerifyWork request;
  BodyArguments bodies;
  std::vector<std::filesystem::path> given;  ///< files that stand for frames: lists, series
  VerdictOutputs outputs;
  std::string time_limit;
  std::string shard;                            ///< "3/64"
  std::optional<std::filesystem::path> shards;  ///< the folder of --shard
};

/// The files that names on the command line stand for.
void name_frames(VerifyArguments& arguments) {
  VerifyWork& request = arguments.request;
  arguments.given = files_named(request.frames);
  if (request.frames.empty() && !arguments.bodies.any()) {
    throw UsageError("`noli verify` needs FRAMES, bodies (--body) or the folder of a run; see `noli verify --help`");
  }
  if (!arguments.bodies.any()) {
    request.frames = named_frames(std::move(request.frames));
    return;
  }
  request.reading.bodies = bodies_of(arguments.bodies, request.order, request.order_notes);
  request.frames = files_of(request.reading.bodies);
}

/// What is kept of each of several meshes.
struct MeshesWanted {
  bool json = false, details = false;
};

report::MeshVerdict verify_mesh(VerifyWork request, MeshesWanted wanted, ProgressBars& bars, double done,
                                double share) {
  const std::string file = request.frames[0].string();
  ProofRoute route(request);
  request.progress = [&](std::string_view work, double part) { bars.show(work, done + share * part, file); };
  VerifyOutcome outcome = run_verify(request);
  route.check(outcome);
  Json json = wanted.json ? report::verify_json(request, outcome) : Json();
  report::Answer answer = report::verify_answer(request, outcome, {.result = "", .details = wanted.details});
  return {file, outcome.verdict, std::move(answer), std::move(outcome.notes), outcome.claim.empty, std::move(json)};
}

/// Verifies each file of the request alone. When the process is interrupted, the files that are left are undecided.
/// Throws as run_verify() and ProofRoute::check().
std::vector<report::MeshVerdict> verify_meshes(VerifyWork request, MeshesWanted wanted) {
  std::vector<report::MeshVerdict> meshes;
  ProgressBars bars;
  const auto files = std::exchange(request.frames, {});  // not copied for each of them
  const double share = 1 / static_cast<double>(files.size());
  request.stop = &interrupted();
  for (const auto& file : files) {
    VerifyWork one = request;
    one.frames = {file};
    meshes.push_back(verify_mesh(std::move(one), wanted, bars, share * static_cast<double>(meshes.size()), share));
  }
  return meshes;
}

/// Files with different meshes, each at rest.
ExitCode verify_each(VerifyWork asked, const VerifyArguments& arguments, const Output& output, const OtherMesh& error) {
  const bool single = asked.proof || asked.trajectory || arguments.outputs.claim_out || arguments.outputs.junit ||
                      arguments.outputs.github || asked.only_new || asked.merge_identical || asked.ignore ||
                      !asked.reading.bodies.empty();
  if (single) {
    throw UsageError(
        fmt::format("--proof, --claim-out, --trajectory, --junit, --github, --only-new, --merge-identical, --ignore, "
                    "--body: are about one mesh, but {}",
                    error.what()));
  }
  const MeshesWanted wanted{arguments.outputs.results.json.has_value(), arguments.outputs.results.verbose};
  const std::vector<report::MeshVerdict> meshes = verify_meshes(std::move(asked), wanted);
  output.write("verify-meshes", report::meshes_answer(meshes, wanted.details),
               wanted.json ? report::meshes_json(meshes) : Json::object());
  return exit_code(report::verdict_of(meshes));
}

/// Outputs of one process, or of the first rank; the others write none.
std::unique_ptr<const Output> output_of(const VerifyArguments& arguments, const Ranks* ranks) {
  const VerifyWork& request = arguments.request;
  if (ranks != nullptr && !ranks->is_first()) return nullptr;
  auto inputs = request.frames;
  inputs.insert(inputs.end(), arguments.given.begin(), arguments.given.end());
  if (request.ignore) inputs.push_back(*request.ignore);
  return std::make_unique<const Output>(arguments.outputs.results, inputs, files_of(request, arguments.outputs));
}

/// Of --shard, which gives no verdict of its own.
ShardWork shard_work(const VerifyArguments& arguments) {
  if (!arguments.shards) throw UsageError("--shard: expected -o SHARDS, the folder that all shards are written to");
  const VerdictOutputs& outputs = arguments.outputs;
  if (outputs.results.json || outputs.junit || outputs.claim_out || outputs.github || arguments.request.proof) {
    throw UsageError(
        "--json, --junit, --claim-out, --github, --proof: are about all steps; pass them to `noli merge`, not with "
        "--shard");
  }
  const ShardNumber shard = parse_shard(arguments.shard);
  return {.folder = *arguments.shards, .number = shard.number, .of = shard.of};
}

ExitCode run(VerifyArguments& arguments) {
  VerifyWork& request = arguments.request;
  if (Ranks::started_by_mpirun() && !arguments.shard.empty()) {
    throw UsageError("--shard: mpirun already divides the steps among its ranks; drop one of the two");
  }
  if (arguments.shards && arguments.shard.empty() && !Ranks::is_mpi_job()) {
    throw UsageError("-o: is the folder of --shard; expected --json OUT, which writes the result");
  }
  request.deadline = begin_work(arguments.time_limit);
  name_frames(arguments);
  require_there(request.frames);
  const bool joined = !request.reading.bodies.empty();
  request.run = !joined && request.frames.size() == 1 && std::filesystem::is_directory(request.frames[0]);
  if (joined) {
    request.ordered = "each body's as given";
  } else if (!request.run) {
    request.put_in_order();
  } else if (request.order != FrameOrder::checked || request.reading.polygons != PolygonRule::fan) {
    throw UsageError("--order, --polygons: apply to frames only; drop them for a run");
  }
  if (request.follow && !request.run) {
    throw UsageError("--follow: is for a run of `noli simulate`; expected its folder, found frames");
  }
  if (request.trajectory && request.run) {
    throw UsageError("--trajectory: is for frames; a run has its trajectory.blocks");
  }
  if (request.divide && arguments.shard.empty() && !Ranks::is_mpi_job()) {
    throw UsageError("--divide: divides one step among processes; add --shard K/N, or use mpirun");
  }
  request.live = request.run && is_locked(request.frames[0]);
  request.prepare_to_reproduce();
  const auto ranks = arguments.shard.empty() ? Ranks::of_this_job() : nullptr;
  const auto output = output_of(arguments, ranks.get());
  if (arguments.outputs.github && arguments.outputs.results.json == "-") {
    throw UsageError("--github, --json -: both write to standard output; expected one of them");
  }
  if (request.min_distance == 0 && request.ring > 1) {
    throw UsageError("--min-distance-from-ring: only works with --min-distance DISTANCE; add that");
  }
  VerifyWork asked = request.constant_motion ? request : VerifyWork{};
  if (!arguments.shard.empty()) return answer_shard(request, shard_work(arguments), *output);
  if (ranks) return answer_in_ranks(request, arguments.shards, *ranks, arguments.outputs, output.get());
  try {
    return answer(request, arguments.outputs, *output);
  } catch (const OtherMesh& error) {
    if (!request.constant_motion) throw;
    return verify_each(std::move(asked), arguments, *output, error);
  }
}

/// What a first use needs.
void add_options(CLI::App& command, VerifyArguments& arguments) {
  VerifyWork& request = arguments.request;
  CLI::Option* const frames =
      command
          .add_option("frames", request.frames,
                      "Frames in the order of time: files, a folder, a pattern, .npz, .vtkhdf and others; or one run")
          ->type_name("FRAMES|RUN");
  add_body_options(command, arguments.bodies, frames);
  add_order_option(command, request.order);
  auto* const keep_going = command.add_flag("--keep-going", request.keep_going,
                                            "Go through all steps instead of stopping at the first with contacts");
  command.add_flag("--first-only", request.first_only, "Stop at any contact; counts are then lower bounds")
      ->excludes(keep_going);
  command.add_option("--proof", request.proof, "Write the proof to this file, for `noli check`")->type_name("OUT");
  command
      .add_option("--trajectory", request.trajectory, "Write all frames, bit for bit, to this block file for checkers")
      ->type_name("OUT");
  command.add_flag_callback(
      "--no-check", [&request] { request.check = false; },
      "Skip the checker, and the proof unless --proof asks for it: the verdict is then no_contact, not proved");
  add_output_options(command, arguments.outputs.results);
  command.add_option("--junit", arguments.outputs.junit, "Write a JUnit file, with a test case for each step")
      ->type_name("OUT.xml")
      ->group(group::output);
  command.add_flag("--github", arguments.outputs.github, "Print annotations for GitHub Actions above the result")
      ->excludes(command.get_option("--porcelain"))
      ->group(group::output);
  command
      .add_option("--shard", arguments.shard,
                  "Decide only the K-th of N parts of the steps, for `noli merge`; needs -o")
      ->type_name("K/N");
  command
      .add_option("-o,--output", arguments.shards,
                  "The folder for results of --shard or of mpirun's ranks; created if missing")
      ->type_name("SHARDS");
  command.add_flag("--divide", request.divide,
                   fmt::format("Cut the step between two frames of a huge mesh into {} tasks, for --shard or mpirun",
                               parts_of_step));
  add_threads_option(command, request.threads);
  command
      .add_option("--max-reports", request.max_reports,
                  "List at most N contacts, spread evenly over the steps; counts do not depend on it")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str()
      ->type_name("N")
      ->group(group::limits);
  add_time_limit_option(command, arguments.time_limit);
}

/// What changes the claim.
void add_question_options(CLI::App& command, VerifyArguments& arguments) {
  VerifyWork& request = arguments.request;
  const auto flag = [&command](const char* name, bool& value, const char* help) {
    command.add_flag(name, value, help)->group(group::question);
  };
  flag("--static", request.constant_motion,
       "Take each frame by itself, at rest: does a mesh intersect itself? Meshes may differ");
  command.add_option("--min-distance", request.min_distance, "Features must stay more than this apart")
      ->check(is_positive())
      ->type_name("DISTANCE")
      ->group(group::question);
  command
      .add_option("--min-distance-from-ring", request.ring,
                  "Features fewer than K mesh edges apart need only be disjoint")
      ->check(CLI::Range(1, 255))
      ->type_name("K")
      ->group(group::question);
  command
      .add_option(
          "--ignore", request.ignore,
          "Groups of vertices whose cells are not compared, a JSON file: {\"groups\": {\"a\": [[0, 99]], \"b\": "
          "[[100, 120], 130]}, \"ignore\": [[\"a\", \"b\"]]}")
      ->type_name("GROUPS.json")
      ->group(group::question);
  flag("--only-new", request.only_new,
       "Leave out pairs of cells that intersect in the first frame: do others touch later?");
  flag("--strict", request.strict, "Also compare the features of one cell with each other");
  flag("--points", request.points, "Treat vertices without a face or edge as particles; else they are ignored");
  flag("--merge-identical", request.merge_identical,
       "Merge vertices whose coordinates are equal in all frames; reads the frames twice");
  command
      .add_option(
          "--dimension", request.dimension,
          "2 ignores z. Default: 2 if all z of the first two frames are equal, else 3; a later frame that leaves "
          "the plane is then an error")
      ->check(is_dimension())
      ->type_name("2|3")
      ->group(group::question);
  add_polygons_option(command, request.reading.polygons);
  add_keys_option(command, request.reading.keys);
  command
      .add_option("--claim-out", arguments.outputs.claim_out,
                  "Write the claim to this file; with `noli check --claim` no proof can claim less")
      ->type_name("CLAIM.json")
      ->group(group::question);
}

void add_run_options(CLI::App& command, VerifyWork& request) {
  constexpr const char* runs = "Runs of noli simulate";
  command
      .add_flag("--follow", request.follow,
                "Verify a run while it is being written, each window when it is committed, until the run ends")
      ->group(runs);
  auto* const again =
      command
          .add_flag(
              "--reproduce", request.reproduce,
              "For a run that recorded frames: integrate its windows again, and verify them if their hashes agree")
          ->group(runs);
  command
      .add_option("--scene-folder", request.scene_folder,
                  "The folder of the scene's file, if the scene names meshes in files")
      ->needs(again)
      ->type_name("FOLDER")
      ->group(runs);
}

}  // namespace

Command add_verify(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("verify", "Did anything touch between these frames?");
  command->footer(verify_footer);
  const auto arguments = std::make_shared<VerifyArguments>();
  add_options(*command, *arguments);
  add_question_options(*command, *arguments);
  add_run_options(*command, arguments->request);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
