// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include <noli/errors.h>
#include <noli/proof.h>
#include "app/bodies.h"
#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/progress.h"
#include "certify/process/run_program.h"
#include "certify/proofs/asked_fields.h"
#include "certify/proofs/check_frames.h"
#include "certify/proofs/check_parts.h"
#include "certify/proofs/check_ranks.h"
#include "certify/ranks/ranks.h"
#include "integrator/scene/json_text.h"
#include "report/check_report.h"
#include "report/joined_check.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* check_footer =
    "Runs the checker: a small, separate program that trusts nothing from noli.\n"
    "\n"
    "You choose what has to be proved, not the proof. By default, that is: frames in motion (or the run), all steps, "
    "every cell, no merged vertices, nothing left out except what trajectory.blocks of a run leaves out (checkers do "
    "not read scene.json), no least distance. A proof of less is rejected, and so is a witness against more. Ask for "
    "one field at a time:\n"
    "  --require motion=rest       each frame by itself (noli verify --static)\n"
    "  --require dimension=2       z does not count (--dimension 2)\n"
    "  --require steps=5           the first five steps, or windows\n"
    "  --require strict            also the features of one cell (--strict)\n"
    "  --require points            also vertices without a cell (--points)\n"
    "  --require distance=0.001    at least this far apart (--min-distance); ring=2 for its ring\n"
    "  --require merged=12         this many vertices may be merged; needs cells=HASH\n"
    "  --require excluded=1-2 --require cells=HASH    pairs of labels that may be left out (--ignore)\n"
    "  --require empty             fewer than two cells that could touch\n"
    "or for all of them with the file that `noli verify --claim-out CLAIM.json` writes.\n"
    "\n"
    "Several processes (--threads) share a proof that is in a file. To share it with other machines, run "
    "`mpirun noli check`, or --shard K/N --json OUT anywhere for each K, and then --join with all answers "
    "(docs/scale.md).\n"
    "\n"
    "Exit codes: 0 what you ask is proved; 1 something touches, and a witness shows it; 2 stopped before an "
    "answer (--time-limit, Ctrl-C); 3 the proof, another input or the command line is at fault; 4 the machine or Noli "
    "failed.\n"
    "Examples:\n"
    "  noli check proof.noli before.ply after.ply\n"
    "  noli check proof.noli frames/*.ply --claim claim.json\n"
    "  noli check proof.noli rest.ply --require motion=rest\n"
    "  noli check runs/cloth                      its proof.blocks, about its trajectory.blocks\n"
    "  noli check proof.noli runs/cloth --verified\n"
    "  noli check proof.noli 'frames/*.ply' --shard 2/4 --json 2.json\n"
    "  noli check --join 1.json 2.json 3.json 4.json\n";

struct CheckArguments {
  std::vector<fs::path> files;
  std::vector<std::string> require;
  std::optional<fs::path> claim;
  bool verified = false, join = false;
  std::optional<std::string> steps, shard;
  int threads = 0;
  FrameOrder order = FrameOrder::checked;
  FrameReading reading;
  BodyArguments bodies;
  std::string time_limit;
  OutputOptions results;
};

/// The steps of --shard K/N: the K-th of N parts of the proof, as A..B or A..
std::string steps_of_shard(const std::string& text, const fs::path& proof) {
  const ShardNumber shard = parse_shard(text);
  const std::vector<std::uint64_t> parts = parts_of_proof(proof, shard.of);
  if (const auto reason = stop_asked()) throw Stopped(*reason, proof.string());
  if (parts.empty()) {
    throw UsageError(
        fmt::format("{}: {}; drop --shard, and `noli check` says what is wrong", proof.string(), proof_cannot_be_cut));
  }
  if (parts.size() < shard.of) {
    const std::size_t steps = parts.size();
    throw UsageError(fmt::format("--shard {}: the proof has {} step{}; expected K/N with N <= {}", text, steps,
                                 steps == 1 ? "" : "s", steps));
  }
  return steps_of_part(parts, shard.number - 1);
}

/// The steps of --steps. Throws UsageError for anything but A..B or A..
std::string parse_steps(const std::string& text) {
  static const std::regex form("([1-9][0-9]{0,8})\\.\\.([1-9][0-9]{0,8})?");
  std::smatch match;
  const bool has_form = text.size() < 32 && std::regex_match(text, match, form);
  if (has_form && (!match[2].matched || std::stoull(match[1].str()) <= std::stoull(match[2].str()))) return text;
  throw UsageError(
      fmt::format("--steps {}: expected A..B with 1 <= A <= B, or A..; 5..5 is only step 5", on_one_line(text)));
}

/// The steps of --steps, --shard or --require steps=A..B; that is taken out of the words. Nothing if all are asked for.
std::optional<std::string> asked_part(const CheckArguments& arguments, const fs::path& proof,
                                      std::vector<std::string>& words) {
  if (!arguments.steps && !arguments.shard) return take_part(words);
  if (asks(arguments.require, "steps")) {
    throw UsageError("--require steps: --steps and --shard choose steps too; expected one of them");
  }
  return arguments.steps ? parse_steps(*arguments.steps) : steps_of_shard(*arguments.shard, proof);
}

/// Sets the bodies; all their files.
OrderedFrames ordered_bodies(CheckArguments& arguments) {
  OrderedFrames ordered;
  arguments.reading.bodies = bodies_of(arguments.bodies, arguments.order, ordered.notes);
  ordered.frames = files_of(arguments.reading.bodies);
  return ordered;
}

/// What to do about a run without a proof; nothing if it is not a run.
std::string way_without_proof(const fs::path& run) {
  const std::string name = shell_words({run.string()});
  try {
    if (RunReader(run).header().record == RecordMode::full) {
      return fmt::format("; `noli verify {} --proof OUT.noli` makes one", name);
    }
    return fmt::format(
        ", but the run recorded only frames; `noli verify {} --reproduce` integrates its windows again and verifies "
        "them",
        name);
  } catch (const InputError&) {
    return "";
  }
}

/// Reads no more of a run than where its windows end. It is for a hint only, so it never fails.
report::RunState state_of_run(const fs::path& run) {
  try {
    RunReader reader(run);
    if (reader.header().record == RecordMode::frames) return report::RunState::only_frames;
    if (is_locked(run)) return report::RunState::being_written;
    while (!stop_asked() && reader.skip_window()) continue;
    if (!stop_asked() && reader.open_window()) return report::RunState::open_window;
  } catch (const std::exception&) {
  }
  return report::RunState::complete;
}

/// The file of the proof. Throws InputError if it does not exist, UsageError if it is a folder.
fs::path proof_of(const CheckArguments& arguments, bool folder) {
  fs::path proof = folder ? arguments.files[0] / "proof.blocks" : arguments.files[0];
  if (!fs::exists(proof)) {
    throw InputError(proof.string(), "",
                     "does not exist; expected a proof" + (folder ? way_without_proof(arguments.files[0]) : ""));
  }
  if (fs::is_directory(proof)) throw UsageError(proof.string() + ": is a folder; expected a proof, or only a run");
  return proof;
}

/// All files that no output may replace.
std::vector<fs::path> inputs_of(const CheckArguments& arguments, const std::vector<fs::path>& frames) {
  std::vector<fs::path> inputs = files_named(arguments.files);
  inputs.insert(inputs.end(), arguments.files.begin(), arguments.files.end());
  inputs.insert(inputs.end(), frames.begin(), frames.end());
  if (arguments.claim) inputs.push_back(*arguments.claim);
  return inputs;
}

/// The answer about a whole proof, from those about its parts.
ExitCode join(const CheckArguments& arguments) {
  if (Ranks::started_by_mpirun()) throw UsageError("--join: runs in one process; start it without mpirun");
  const bool asks_more = !arguments.require.empty() || arguments.claim || arguments.verified ||
                         arguments.bodies.any() || arguments.order != FrameOrder::checked ||
                         !arguments.reading.keys.empty() || arguments.threads != 0;
  if (asks_more) throw UsageError("--join: takes only files of answers and output options; drop all others");
  const Output output(arguments.results, arguments.files);
  std::vector<report::PartAnswer> answers;
  for (const fs::path& file : arguments.files) {
    answers.push_back({file.string(), integrator::parse_json(read_whole_file(file), file.string())});
  }
  const report::Checked checked = report::joined_check(answers);
  output.write("check", report::check_answer(checked), report::check_json(checked));
  return ExitCode::holds;
}

ExitCode run(CheckArguments& arguments) {
  begin_work(arguments.time_limit);
  if (arguments.join) return join(arguments);
  const bool folder = arguments.files.size() == 1 && fs::is_directory(arguments.files[0]);
  const bool has_bodies = arguments.bodies.any();
  if (has_bodies && (folder || arguments.files.size() != 1))
    throw UsageError("--body: expected one proof besides the bodies");
  if (!folder && !has_bodies && arguments.files.size() < 2) {
    throw UsageError("expected a run's folder, or a proof and its frames or run");
  }
  const auto ranks = Ranks::of_this_job();
  const OrderedFrames ordered =
      has_bodies
          ? ordered_bodies(arguments)
          : order_frames(folder ? arguments.files : named_frames({arguments.files.begin() + 1, arguments.files.end()}),
                         arguments.order);
  const std::vector<fs::path>& trajectory = ordered.frames;
  const fs::path proof = proof_of(arguments, folder);
  std::optional<const Output> output;  // of the first rank alone
  if (!ranks || ranks->is_first()) output.emplace(arguments.results, inputs_of(arguments, ordered.frames));
  std::vector<std::string> notes = ordered.notes, asked = arguments.require;
  const auto part = asked_part(arguments, proof, asked);
  if (arguments.claim) ask_for_claim(*arguments.claim, asked);
  const bool of_run = trajectory.size() == 1 && fs::is_directory(trajectory[0]);
  if (of_run) {
    if (output && !arguments.results.quiet) note_if_being_written(trajectory[0]);
    ask_for_all_windows(trajectory[0], asked, notes);
  }
  const std::uint64_t least_steps = part ? ask_for_part(*part, proof, asked) : 0;
  const Checker which = arguments.verified ? Checker::verified : Checker::plain;
  CheckRequest request{.checker = which,
                       .proof = proof,
                       .trajectory = trajectory_for_checker(trajectory),
                       .asked = asked,
                       .checkers = arguments.threads};
  std::optional<ProgressBars> bars;
  if (output) bars.emplace();
  if (output) request.progress = [&bars](double share) { bars->show("check", share); };
  const auto verdict = ranks ? check_in_ranks(request, arguments.reading, *ranks, tell_note)
                             : std::optional(check_motion(request, arguments.reading));
  bars.reset();
  if (!verdict || !output) return end_of(*ranks, ExitCode::holds);  // the first rank's becomes that of all
  constexpr std::string_view at_fault = "rejected: the command line, ";
  if (verdict->words.starts_with(at_fault)) throw UsageError(first_line(verdict->words).substr(at_fault.size()));
  report::Checked checked{version_of(which), proof, asked, *verdict, notes, least_steps};
  if (of_run && verdict->code == 3) checked.run = state_of_run(trajectory[0]);
  output->write("check", report::check_answer(checked), report::check_json(checked));
  const auto code = static_cast<ExitCode>(verdict->code);
  return ranks ? end_of(*ranks, code) : code;
}

}  // namespace

Command add_check(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("check", "Does a proof hold?");
  command->footer(check_footer);
  const auto arguments = std::make_shared<CheckArguments>();
  command
      ->add_option("files", arguments->files,
                   "A proof, then its frames (as for noli verify) or its run; only a run; with --join, answers")
      ->required()
      ->type_name("PROOF TRAJECTORY | RUN | ANSWERS");
  command
      ->add_option("--require", arguments->require,
                   "A field of the claim that the proof has to make; may be repeated")
      ->type_name("FIELD=VALUE")
      ->allow_extra_args(false);  // what follows one are files
  command->add_option("--claim", arguments->claim, "The same from the file that `noli verify --claim-out` writes")
      ->type_name("CLAIM.json");
  CLI::Option* const steps =
      command->add_option("--steps", arguments->steps, "Check only these steps, counted from 1")->type_name("A..B|A..");
  CLI::Option* const shard =
      command->add_option("--shard", arguments->shard, "Check only the K-th of N parts of the steps, with one process")
          ->type_name("K/N")
          ->excludes(steps);
  command
      ->add_flag("--join", arguments->join,
                 "Join the answers about all parts of a proof, files of --shard K/N --json OUT; checks nothing again")
      ->excludes(steps, shard);
  command->add_flag("--verified", arguments->verified, "Use the checker that was extracted from its proof in Coq");
  add_order_option(*command, arguments->order);
  add_keys_option(*command, arguments->reading.keys);
  add_body_options(*command, arguments->bodies, nullptr);
  add_threads_option(*command, arguments->threads);
  add_time_limit_option(*command, arguments->time_limit);
  add_output_options(*command, arguments->results);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
