// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "noli/app/checker.h"
#include "noli/app/commands.h"
#include "noli/app/duration.h"
#include "noli/app/machine.h"
#include "noli/app/options.h"
#include "noli/app/output.h"
#include "noli/app/run_folder.h"
#include "noli/app/verify_report.h"
#include "noli/app/verify_run.h"
#include "noli/trajectory/error.h"

namespace noli::app {
namespace {

constexpr const char* footer =
    "Every step from one frame to the next is decided exactly. The first step that has a contact is counted to its "
    "end, then the run\n"
    "stops. Standard output begins with the verdict line; verdicts: no_contact or,\n"
    "if a checker has accepted the proof of it, proved (exit 0), contact (1), undecided (2).\n"
    "Steps are counted from 1 (for a run they are its windows): `steps` were looked at, `steps_total` there are; times "
    "are in [0, 1] of their step (for a run, in "
    "seconds). `first_time` is of the first pair of features that "
    "meets: null when\n"
    "none does, also where cells intersect from the beginning to the end without any.\n"
    "Examples:\n"
    "  noli verify before.ply after.ply\n"
    "  noli verify frames/*.obj --keep-going --json result.json\n"
    "  noli verify rest.ply --static --strict        does this mesh intersect itself?\n"
    "  noli verify a.ply b.ply --json - | jq .first\n"
    "  noli verify a.ply b.ply --proof ab.noli       and a proof that anybody can check: noli check ab.noli a.ply "
    "b.ply\n"
    "  noli verify a.ply b.ply --time-limit 10s --threads 1\n"
    "  noli verify runs/cloth                        a run of `noli simulate` again, from its files alone";

struct VerifyArguments {
  VerifyRequest request;
  std::string time_limit;
  std::optional<std::string> json;
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

/// The proof is made anew; it may not be one of the files that are read.
void require_place_of_proof(const std::filesystem::path& proof, const std::vector<std::filesystem::path>& frames) {
  require_other_file(proof, with_files_of_runs(frames), "--proof");
  require_writable_file(proof, "--proof");
}

/// Has the checker look at a proof that is complete. What it refuses is an error of this program.
void check(const VerifyRequest& request, VerifyOutcome& outcome) {
  const bool whole =
      outcome.verdict == Verdict::no_contact ||
      ((outcome.verdict == Verdict::contact || outcome.verdict == Verdict::too_near) && outcome.witnesses > 0);
  if (!whole) return;
  const Stopwatch watch;
  const CheckerVerdict verdict = run_checker(Checker::plain, *request.proof, trajectory_for_checker(request.frames));
  outcome.check_seconds = watch.seconds();
  outcome.checked = verdict.words.substr(0, verdict.words.find('\n'));
  const int expected = outcome.verdict == Verdict::no_contact ? 0 : 1;
  if (verdict.code != expected) {
    throw std::runtime_error("the checker did not take the proof, which says that one of the two is wrong: " +
                             *outcome.checked);
  }
  if (expected == 0) outcome.verdict = Verdict::proved;
}

/// Before anything else is said about a single one.
void require_there(const std::vector<std::filesystem::path>& frames) {
  std::error_code error;
  if (frames.size() != 1 || std::filesystem::exists(std::filesystem::status(frames[0], error))) return;
  throw InputError(frames[0].string(), "", "cannot be opened: there is no such file or folder");
}

ExitCode run(VerifyArguments& arguments) {
  VerifyRequest& request = arguments.request;
  if (!arguments.time_limit.empty()) request.time_limit = parse_duration(arguments.time_limit, "--time-limit");
  require_there(request.frames);
  request.run = request.frames.size() == 1 && std::filesystem::is_directory(request.frames[0]);
  const Output output(arguments.json, with_files_of_runs(request.frames));
  if (request.min_distance > 0 && !request.proof) {
    throw UsageError("--min-distance: is decided by its proof; expected --proof OUT");
  }
  if (request.min_distance == 0 && request.ring > 1) {
    throw UsageError("--min-distance-from-ring: says who may be near; expected --min-distance DISTANCE");
  }
  if (request.run && request.min_distance > 0) {
    throw UsageError("--min-distance: is for frames; expected it without a run");
  }
  if (request.proof) require_place_of_proof(*request.proof, request.frames);
  VerifyOutcome outcome = request.run ? run_verify_motion(request) : run_verify(request);
  if (request.proof && request.check) check(request, outcome);
  output.write(verify_text(request, outcome), verify_json(request, outcome));
  return exit_code(outcome.verdict);
}

void add_options(CLI::App& command, VerifyArguments& arguments) {
  VerifyRequest& request = arguments.request;
  command.add_option("frames", request.frames, "PLY or OBJ files, in the order of time; or the folder of one run")
      ->required()
      ->type_name("FRAMES | RUN");
  add_json_option(command, arguments.json);
  add_threads_option(command, request.threads);
  command.add_option("--max-reports", request.max_reports, "List at most so many contacts; counts are always exact")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str()
      ->type_name("N");
  command.add_option("--time-limit", arguments.time_limit, "Stop after this time, undecided: 500ms, 60s, 5m, 1h")
      ->type_name("TIME");
  command
      .add_option("--min-distance", request.min_distance,
                  "Features have to be more than this apart; needs --proof, which is what decides it")
      ->check(is_positive())
      ->type_name("DISTANCE");
  command
      .add_option("--min-distance-from-ring", request.ring,
                  "But for features that a path of fewer than K mesh edges joins: these have to be disjoint")
      ->check(CLI::Range(1, 255))
      ->type_name("K");
  command.add_option("--proof", request.proof, "Write the proof there, a file that `noli check` checks")
      ->type_name("OUT");
  command
      .add_option("--dimension", request.dimension,
                  "2 or 3; by default 2 if all z of the first two frames are equal, else 3. A later frame that leaves "
                  "the plane is then refused")
      ->check(is_dimension())
      ->type_name("2|3");
}

void add_flags(CLI::App& command, VerifyRequest& request) {
  auto* keep_going = command.add_flag("--keep-going", request.keep_going, "Go through all steps, contacts or not");
  command.add_flag("--first-only", request.first_only, "Be content with the first contact found")->excludes(keep_going);
  command.add_flag("--strict", request.strict, "Also compare the features of one cell with each other");
  command.add_flag("--points", request.points, "Vertices that nothing refers to are particles");
  command.add_flag("--static", request.constant_motion, "Each frame by itself, at rest");
  command.add_flag("--merge-identical", request.merge_identical,
                   "Make one vertex of those whose coordinates are equal in all frames (reads them twice)");
  command.add_flag("!--no-check", request.check, "Do without the check of the proof: the verdict stays no_contact");
}

}  // namespace

Command add_verify(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("verify", "Did anything touch between these frames?");
  command->footer(footer);
  const auto arguments = std::make_shared<VerifyArguments>();
  add_options(*command, *arguments);
  add_flags(*command, arguments->request);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
