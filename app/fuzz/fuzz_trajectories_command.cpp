// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/audit/library_options.h"
#include "app/commands.h"
#include "app/fuzz/fuzz_options.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/fuzz/trajectories/fuzz_trajectories_report.h"
#include "audit/fuzz/trajectories/motion_generators.h"
#include "audit/fuzz/trajectories/replay_motion.h"
#include "audit/fuzz/trajectories/verify_program.h"
#include "certify/json.h"
#include "certify/result_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* trajectories_footer =
    "Makes motions of small meshes whose contacts are planted at a known time and place, or missed by one "
    "unit in the last place. Each is written as PLY or OBJ, read back and verified; both checkers see its "
    "proof or witness. A wrong answer is shrunk and saved as frames, with the command that shows it again.\n"
    "\n"
    "With --library the motions go through a third-party pipeline instead, step by step: its search for candidates "
    "(all pairs, if it has none), then its query for each of them. The library has the functions of noli/ccd_plugin.h "
    "and runs in a separate process. Findings are contacts that are missed or are not candidates, late or absent "
    "times, failures, crashes, hangs and leaks; of an --exact library also false positives and early times.\n"
    "\n"
    "With --count and without a corpus the result depends only on the seed. Exit codes: 0 no finding; 1 findings; 2 "
    "interrupted; 3 a library or folder is at fault.\n"
    "Examples:\n"
    "  noli fuzz trajectories --for 60s --seed 1\n"
    "  noli fuzz trajectories --library ./mine.so --for 60s --tolerance 1e-6\n"
    "  noli fuzz trajectories --count 100000 --threads 2 --corpus corpus --json result.json\n"
    "  noli fuzz trajectories --family last_ulp --family landing --count 10000\n"
    "  noli fuzz trajectories --replay fuzz-findings/seed1-block3-index7-border\n"
    "  noli fuzz trajectories --minimise fuzz-findings/seed1-block3-index7-border --out smaller\n";

struct TrajectoriesArguments {
  FuzzArgumentsInCommon common;
  ReplayArguments replay;
  LibraryArguments theirs;
  std::size_t max_findings = 20;
  std::vector<std::string> families;  ///< names of generators; none: all of them
  std::uint64_t verified_every = 1;
};

/// {"noli", "fuzz", "trajectories", "--library", "./mine.so", "--tolerance", "1e-06", "--replay"}, without the folder.
std::vector<std::string> replay_command(const LibraryArguments& library) {
  std::vector<std::string> words = {"noli", "fuzz", "trajectories"};
  const std::vector<std::string> more = library_words(library);
  words.insert(words.end(), more.begin(), more.end());
  words.emplace_back("--replay");
  return words;
}

/// Copies the options that both kinds have, and runs a fuzzer.
template <class Options, class Fuzz>
ExitCode fuzz(const TrajectoriesArguments& arguments, Options& options, const Output& output, const char* schema,
              const Fuzz& fuzzer) {
  set_common(options, arguments.common);
  options.families = arguments.families;
  options.max_findings = arguments.max_findings;
  options.replay_command = replay_command(arguments.theirs);
  return run_fuzzer("fuzz trajectories", schema, output, options, fuzzer);
}

ExitCode fuzz_noli(TrajectoriesArguments& arguments) {
  const Output output = begin_fuzzing(arguments.common, {});
  audit::VerifyProgram subject(arguments.verified_every, interrupted());
  note_missing_verified_checker();
  audit::TrajectoryOptions options;
  options.decide = [&](const audit::FrameMotion& motion) { return subject(motion); };
  return fuzz(arguments, options, output, "fuzz-trajectories", audit::fuzz_trajectories);
}

ExitCode fuzz_library(TrajectoriesArguments& arguments) {
  const Output output = begin_fuzzing(arguments.common, {arguments.theirs.asked.path});
  audit::LibraryMotionOptions options;
  options.asked = arguments.theirs.asked;
  options.first_only = arguments.theirs.first_only;
  return fuzz(arguments, options, output, "fuzz-library-trajectories", audit::fuzz_library_motions);
}

/// A saved motion again, as it is or made smaller.
ExitCode replay(const TrajectoriesArguments& arguments) {
  const fs::path folder = arguments.replay.saved();
  const bool asks_a_library = arguments.theirs.asks_a_library(), smaller = arguments.replay.minimise.has_value();
  const audit::LibraryUnderTest& library = arguments.theirs.asked;
  std::vector<fs::path> inputs = saved_files(folder);
  if (asks_a_library) inputs.push_back(library.path);
  const Output output(arguments.common.results, inputs);
  if (smaller) require_writable_folder(arguments.common.out, "--out");
  audit::FrameMotion motion = audit::read_frames(folder);
  const audit::ReplayedMotion judged = asks_a_library ? audit::replay_motion(library, std::move(motion), smaller)
                                                      : audit::replay_motion(std::move(motion), smaller, interrupted());
  const std::vector<std::string> command = replay_command(arguments.theirs);
  std::optional<fs::path> saved;
  if (judged.difference && smaller) {
    saved = minimised_folder(arguments.common, folder);
    audit::save_motion(judged.motion, *judged.difference, command, *saved);
  }
  Json facts = Json::object();
  if (asks_a_library) facts["library"] = library.path.string();
  facts.update(audit::motion_facts(judged.motion));
  return tell_replay(
      output, {.unknown = interrupted() || (judged.undecided && !judged.difference),
               .difference = judged.difference,
               .saved = saved,
               .facts = facts,
               .pairs = {"frames", "cells", "vertices"},
               .about_saved = saved && asks_a_library ? "\n  again: " + audit::replay_line(command, *saved) : ""});
}

ExitCode run(TrajectoriesArguments& arguments) {
  const bool asks_a_library = arguments.theirs.asks_a_library();
  if (asks_a_library) {
    settle_library(arguments.theirs);
    audit::HostOptions& host = arguments.theirs.asked.host;
    host.repeat_seconds = 0.01;  // for one step of a small mesh: thousands of calls
    host.search_limit = 1;       // the same
  }
  if (arguments.replay.given()) return replay(arguments);
  return asks_a_library ? fuzz_library(arguments) : fuzz_noli(arguments);
}

}  // namespace

Command add_fuzz_trajectories(CLI::App& fuzz_app) {
  CLI::App* const command =
      fuzz_app.add_subcommand("trajectories", "Whole motions with planted contacts: noli, or a library's pipeline");
  command->footer(trajectories_footer);
  const auto arguments = std::make_shared<TrajectoriesArguments>();
  add_fuzz_options(*command, arguments->common, "motions");
  command->add_option("--max-findings", arguments->max_findings, "Shrink and save at most N")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str()
      ->type_name("N");
  CLI::Option* const verified_every =
      command
          ->add_option("--verified-every", arguments->verified_every, "Ask the verified checker about one in N motions")
          ->check(whole_number(1, 1'000'000))
          ->capture_default_str()
          ->type_name("N");
  add_library_options(*command, arguments->theirs, "noli verify and the checkers");
  std::vector<std::string> names;
  for (const audit::MotionGenerator& generator : audit::motion_generators()) names.emplace_back(generator.name);
  command->add_option("--family", arguments->families, "Make motions of this family; can be given several times")
      ->check(CLI::IsMember(names))
      ->allow_extra_args(false)
      ->type_name("NAME");
  add_replay_options(*command, arguments->replay, "motion", "FOLDER", {"--first-only", "--max-findings", "--family"});
  command->get_option("--library")->excludes(verified_every);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
