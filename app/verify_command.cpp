// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include <noli/errors.h>
#include <noli/verify.h>
#include "app/bodies.h"
#include "app/commands.h"
#include "app/help.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "app/progress.h"
#include "app/verify_meshes.h"
#include "certify/process/child.h"
#include "certify/process/scratch_folder.h"
#include "certify/proofs/checker.h"
#include "certify/proofs/claim.h"
#include "certify/proofs/proof_route.h"
#include "certify/result_file.h"
#include "certify/runs/run_folder.h"
#include "certify/stopwatch.h"
#include "report/meshes_report.h"
#include "report/verify_ci.h"
#include "report/verify_report.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frames.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

constexpr const char* verify_footer =
    "Decides each step from one frame to the next exactly: every vertex moves along a straight line, and "
    "coordinates are taken as they are. A separate checker then checks the proof. The last line is the "
    "verdict:\n"
    "  proved      the checker accepted the proof: nothing touches            exit 0\n"
    "  no_contact  decided exactly, not checked (--no-check, or a note: why)  exit 0\n"
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
    "  noli verify runs/cloth --follow               the same while it is written\n"
    "  noli verify runs/ring --reproduce             a run that recorded frames only\n";

struct VerifyArguments {
  VerifyRequest request;
  BodyWords bodies;
  std::vector<std::filesystem::path> given;  ///< files that stand for frames: lists, series
  std::optional<std::filesystem::path> claim_out, junit;
  bool github = false;  ///< annotations for GitHub Actions on standard output
  std::string time_limit;
  OutputOptions results;
};

ExitCode exit_code(Verdict verdict) {
  switch (verdict) {
    case Verdict::no_contact:
    case Verdict::proved: return ExitCode::holds;
    case Verdict::contact:
    case Verdict::too_near: return ExitCode::refuted;
    case Verdict::undecided: return ExitCode::undecided;
  }
  return ExitCode::failure;
}

/// Beside the results.
std::vector<OutputFile> outputs_of(const VerifyArguments& arguments) {
  std::vector<OutputFile> files;
  if (const auto& proof = arguments.request.proof) {
    if (*proof == "-") throw UsageError("--proof -: a proof is not text; expected the name of a file");
    files.push_back({"--proof", *proof, true});
  }
  if (const auto& claim = arguments.claim_out) {
    if (*claim == "-") throw UsageError("--claim-out -: expected the name of a file");
    files.push_back({"--claim-out", *claim});
  }
  if (const auto& trajectory = arguments.request.trajectory) {
    if (*trajectory == "-") throw UsageError("--trajectory -: expected the name of a file");
    files.push_back({"--trajectory", *trajectory, true});
  }
  if (const auto& junit = arguments.junit) {
    if (*junit == "-") throw UsageError("--junit -: expected the name of a file");
    files.push_back({"--junit", *junit});
  }
  return files;
}

/// What goes with --reproduce, and what does not.
void prepare_to_reproduce(VerifyRequest& request) {
  if (request.reproduce && !request.run) {
    throw UsageError("--reproduce: is for a run of `noli simulate`; expected its folder, found frames");
  }
  request.lines_in_no_file = request.reproduce && RunReader(request.frames[0]).header().record == RecordMode::frames;
  if (request.lines_in_no_file && request.follow) {
    throw UsageError(
        "--follow: the run recorded frames alone, whose windows are integrated again only when all are there; expected "
        "a run with \"record\": \"full\", or no --follow");
  }
  if (request.lines_in_no_file && request.proof) {
    throw UsageError(
        "--proof: is about world lines in a file, and the run recorded frames alone; expected a run with \"record\": "
        "\"full\", or no --proof");
  }
}

/// The motion of a run, kept open: whoever replaces the run while it is read makes another file.
class MotionFile {
 public:
  explicit MotionFile(const VerifyRequest& request) {
    if (!request.run) return;
    path_ = trajectory_path(request.frames[0]);
    file_.take(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  }

  bool was_replaced() const {
    struct stat opened = {}, named = {};
    if (file_.get() < 0 || ::fstat(file_.get(), &opened) != 0) return false;
    return ::stat(path_.c_str(), &named) != 0 || opened.st_dev != named.st_dev || opened.st_ino != named.st_ino;
  }

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

/// "step 3 of 11, cloth_4.obj": which part of the work a share of it is.
std::string where(const VerifyRequest& request, std::string_view work, double share) {
  const std::size_t count = request.frames.size() - (work == "look" || request.constant_motion ? 0 : 1);
  const auto done = static_cast<std::size_t>(share * static_cast<double>(count));
  const std::size_t number = std::min(done + 1, count), frame = request.frames.size() - count + number - 1;
  return fmt::format("{} {} of {}, {}", work == "look" ? "frame" : "step", number, count,
                     on_one_line(request.frames[frame].filename().string()));
}

VerifyOutcome verify(const VerifyRequest& request, ProofRoute& route) {
  const MotionFile motion(request);
  try {
    VerifyOutcome outcome = request.run ? run_verify_motion(request) : run_verify(request);
    route.check(outcome);
    return outcome;
  } catch (const std::exception&) {
    if (!motion.was_replaced()) throw;
    throw InputError(request.frames[0].string(), "", "was replaced while it was read; expected a run that stays");
  }
}

/// The files that names on the command line stand for.
void name_frames(VerifyArguments& arguments) {
  VerifyRequest& request = arguments.request;
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

/// Frames of one mesh, or a run.
ExitCode verify_all(VerifyArguments& arguments, const Output& output) {
  VerifyRequest& request = arguments.request;
  ProofRoute route(request);
  request.stop = &interrupted();
  std::optional<ProgressBars> bars(std::in_place);
  const bool told = !request.run && request.frames.size() > 2 && request.reading.bodies.empty() &&
                    std::ranges::all_of(request.frames, is_frame_name);
  request.progress = [&](std::string_view work, double share) {
    bars->show(work, share, told ? where(request, work, share) : "");
  };
  const VerifyOutcome outcome = verify(request, route);
  bars.reset();
  if (arguments.claim_out && outcome.claim.cells.empty()) {
    tell_note("no claim was written: no step was looked at");
  } else if (arguments.claim_out) {
    write_file(*arguments.claim_out, to_text(claim_file(outcome.claim)));
  }
  if (arguments.junit) write_result(*arguments.junit, report::verify_junit(request, outcome));
  if (arguments.github) write_standard_output(report::verify_annotations(request, outcome));
  // The JSON of 10,000 frames takes more memory than all else.
  Json json = arguments.results.json ? report::verify_json(request, outcome) : Json::object();
  const report::WordsWanted wanted{arguments.results.json.value_or(""), arguments.results.verbose};
  output.write("verify", report::verify_answer(request, outcome, wanted), std::move(json));
  return exit_code(outcome.verdict);
}

/// Files with different meshes, each at rest.
ExitCode verify_each(VerifyRequest asked, const VerifyArguments& arguments, const Output& output,
                     const OtherMesh& error) {
  const bool single = asked.proof || asked.trajectory || arguments.claim_out || arguments.junit || arguments.github ||
                      asked.only_new || asked.merge_identical || asked.ignore || !asked.reading.bodies.empty();
  if (single) {
    throw UsageError(
        fmt::format("--proof, --claim-out, --trajectory, --junit, --github, --only-new, --merge-identical, --ignore, "
                    "--body: are about one mesh, but {}",
                    error.what()));
  }
  const MeshesWanted wanted{arguments.results.json.has_value(), arguments.results.verbose};
  const std::vector<report::MeshVerdict> meshes = verify_meshes(std::move(asked), wanted);
  output.write("verify-meshes", report::meshes_answer(meshes, wanted.details),
               wanted.json ? report::meshes_json(meshes) : Json::object());
  return exit_code(report::verdict_of(meshes));
}

ExitCode run(VerifyArguments& arguments) {
  VerifyRequest& request = arguments.request;
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
    throw UsageError("--order, --polygons: are for frames; expected none of them with a run");
  }
  if (request.follow && !request.run) {
    throw UsageError("--follow: is for a run of `noli simulate`; expected its folder, found frames");
  }
  if (request.trajectory && request.run) {
    throw UsageError("--trajectory: is for frames; a run has its trajectory.blocks");
  }
  request.live = request.run && is_locked(request.frames[0]);
  prepare_to_reproduce(request);
  auto inputs = request.frames;
  inputs.insert(inputs.end(), arguments.given.begin(), arguments.given.end());
  if (request.ignore) inputs.push_back(*request.ignore);
  const Output output(arguments.results, inputs, outputs_of(arguments));
  if (arguments.github && arguments.results.json == "-") {
    throw UsageError("--github, --json -: both write to standard output; expected one of them");
  }
  if (request.min_distance == 0 && request.ring > 1) {
    throw UsageError("--min-distance-from-ring: says who may be near; expected --min-distance DISTANCE");
  }
  inputs = {};  // paths of 10,000 frames are megabytes
  VerifyRequest asked = request.constant_motion ? request : VerifyRequest{};
  try {
    return verify_all(arguments, output);
  } catch (const OtherMesh& error) {
    if (!request.constant_motion) throw;
    return verify_each(std::move(asked), arguments, output, error);
  }
}

/// What a first use needs.
void add_options(CLI::App& command, VerifyArguments& arguments) {
  VerifyRequest& request = arguments.request;
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
      .add_option("--trajectory", request.trajectory,
                  "Write all frames to this block file, which checkers read: numbers bit for bit")
      ->type_name("OUT");
  command.add_flag_callback(
      "--no-check", [&request] { request.check = false; },
      "Skip the checker, and the proof unless --proof asks for it: the verdict is then no_contact, not proved");
  add_output_options(command, arguments.results);
  command.add_option("--junit", arguments.junit, "Write a JUnit file, with a test case for each step")
      ->type_name("OUT.xml")
      ->group(group::output);
  command.add_flag("--github", arguments.github, "Print annotations for GitHub Actions above the result")
      ->excludes(command.get_option("--porcelain"))
      ->group(group::output);
  add_threads_option(command, request.threads);
  command
      .add_option("--max-reports", request.max_reports,
                  "List at most N contacts, shared fairly by the steps; counts do not depend on it")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str()
      ->type_name("N")
      ->group(group::limits);
  add_time_limit_option(command, arguments.time_limit);
}

/// What changes the claim.
void add_question_options(CLI::App& command, VerifyArguments& arguments) {
  VerifyRequest& request = arguments.request;
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
      .add_option("--claim-out", arguments.claim_out,
                  "Write the claim to this file; with `noli check --claim` no proof can claim less")
      ->type_name("CLAIM.json")
      ->group(group::question);
}

void add_run_options(CLI::App& command, VerifyRequest& request) {
  constexpr const char* runs = "Runs of noli simulate";
  command
      .add_flag("--follow", request.follow,
                "Verify a run while it is written, each window when it is committed, to the run's end")
      ->group(runs);
  auto* const again =
      command
          .add_flag("--reproduce", request.reproduce,
                    "Of a run that recorded frames: integrate its windows again, and verify them if their hashes agree")
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
