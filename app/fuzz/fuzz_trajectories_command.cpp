// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/fuzz/fuzz_library_motions_run.h"
#include "app/fuzz/fuzz_options.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/fuzz/trajectories/motion_generators.h"
#include "audit/fuzz/trajectories/verify_program.h"
#include "certify/json.h"
#include "certify/result_file.h"
#include "trajectory/write_file.h"

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

struct TrajectoriesArguments : LibraryMotionArguments {
  std::uint64_t verified_every = 1;
};

std::uint64_t undecided(const audit::TrajectoryReport& report) {
  std::uint64_t count = 0;
  for (const audit::TrajectoryTally& generator : report.generators) count += generator.undecided;
  return count;
}

Json report_json(const TrajectoriesArguments& arguments, const audit::TrajectoryReport& report) {
  Json json = {{"verdict", report.verdict()},
               {"seed", arguments.common.limits.seed},
               {"trajectories", report.items},
               {"findings", report.findings_total},
               {"undecided", undecided(report)},
               {"checked", {{"plain", report.checked_plain}, {"verified", report.checked_verified}}},
               {"shapes", report.shapes},
               {"corpus", report.corpus_size}};
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) json["reports"].push_back(finding_json(finding, "folder"));
  json["generators"] = Json::array();
  for (const auto& generator : report.generators) {
    json["generators"].push_back({{"name", generator.name},
                                  {"apart", generator.apart},
                                  {"contact", generator.contact},
                                  {"without_witness", generator.without_witness},
                                  {"undecided", generator.undecided}});
  }
  return json;
}

std::string report_text(const TrajectoriesArguments& arguments, const audit::TrajectoryReport& report) {
  std::string text;
  for (const auto& finding : report.findings) text += finding_line(finding, "motion");
  for (const auto& generator : report.generators) {
    text += fmt::format("  {:12} apart {:6} contact {:6} without_witness {}\n", generator.name, generator.apart,
                        generator.contact, generator.without_witness);
  }
  if (arguments.common.corpus) text += fmt::format("Corpus: {} motions.\n", report.corpus_size);
  return text + fmt::format("The verified checker looked at {} proofs. Not decided in time: {}. Shapes: {}.\n",
                            report.checked_verified, undecided(report), report.shapes);
}

ExitCode fuzz(TrajectoriesArguments& arguments) {
  const Output output = begin_fuzzing(arguments.common, {});
  audit::VerifyProgram subject(arguments.verified_every, interrupted());
  if (!subject.has_verified_checker()) std::fputs("noli: noli_check_verified was not found and is skipped\n", stderr);
  audit::TrajectoryOptions options;
  set_common(options, arguments.common);
  options.families = arguments.families;
  options.decide = [&](const audit::FrameMotion& motion) { return subject(motion); };
  options.max_findings = arguments.max_findings;
  options.replay_command = {"noli", "fuzz", "trajectories", "--replay"};
  return run_fuzzer(
      {"fuzz trajectories", "fuzz-trajectories", {"trajectories", "findings", "checked=checked/plain", "seed"}}, output,
      options, audit::fuzz_trajectories, [&](const auto& report) { return report_json(arguments, report); },
      [&](const auto& report) { return report_text(arguments, report); });
}

/// A saved motion again, as it is or made smaller.
ExitCode replay(const TrajectoriesArguments& arguments) {
  const fs::path folder = arguments.replay.saved();
  const Output output(arguments.common.results, saved_files(folder));
  if (arguments.replay.minimise) require_writable_folder(arguments.common.out, "--out");
  audit::FrameMotion motion = audit::read_frames(folder);
  audit::VerifyProgram subject(1, interrupted());
  bool undecided = false;  // the last one, in the time that there was
  const auto decide = [&](const audit::FrameMotion& one) {
    audit::MotionAnswer answer = subject(one);
    undecided = answer.undecided;
    return answer;
  };
  const auto what = [&](const audit::FrameMotion& candidate) {
    return audit::difference(candidate, decide, &interrupted());
  };
  auto found = what(motion);
  std::optional<fs::path> saved;
  if (found && arguments.replay.minimise) {
    const std::string kind(audit::kind_of(*found));
    motion = audit::minimise(
        motion, [&](const audit::FrameMotion& candidate) { return audit::is_of_kind(what(candidate), kind); }, 5000);
    if (auto still = what(motion)) found = std::move(still);
    saved = minimised_folder(arguments.common, folder);
    const std::vector<std::string> command = {"noli", "fuzz", "trajectories", "--replay"};
    audit::save_motion(motion, *found, command, *saved);
  }
  return tell_replay(output, {.unknown = interrupted() || (undecided && !found),
                              .difference = found,
                              .saved = saved,
                              .facts = motion_facts(motion),
                              .pairs = {"frames", "cells", "vertices"}});
}

ExitCode run(TrajectoriesArguments& arguments) {
  const bool saved = arguments.replay.given();
  if (arguments.theirs.asks_a_library()) {
    return saved ? replay_motion_of_library(arguments) : fuzz_motions_of_library(arguments);
  }
  return saved ? replay(arguments) : fuzz(arguments);
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
