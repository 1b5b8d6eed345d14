// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/fuzz/fuzz_options.h"
#include "app/output.h"
#include "app/output_files.h"
#include "app/process.h"
#include "audit/fuzz/scenes/fuzz_scenes_report.h"
#include "certify/result_file.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* scenes_footer =
    "Makes small scenes with one extreme property. Each is simulated, its run verified and its proof "
    "checked; then it is simulated again with an interruption, after which it must resume to the same bytes. "
    "Some scenes are wrong in one place, which the message must name. A finding is shrunk and saved as a "
    "scene, with the command that shows it again.\n"
    "\n"
    "With --count the scenes depend only on the seed. Exit codes: 0 no finding; 1 findings; 2 interrupted.\n"
    "Examples:\n"
    "  noli fuzz scenes --for 60s --seed 1\n"
    "  noli fuzz scenes --count 10000 --json result.json\n"
    "  noli fuzz scenes --replay fuzz-findings/seed1-block3-index2-fast/scene.json\n"
    "  noli fuzz scenes --minimise scene.json --out smaller\n";

struct ScenesArguments {
  FuzzArgumentsInCommon common;
  ReplayArguments replay;
  std::optional<std::string> wrong_place;
};

ExitCode fuzz(ScenesArguments& arguments) {
  if (arguments.wrong_place) throw UsageError("--wrong-place goes with --replay");
  const Output output = begin_fuzzing(arguments.common, {});
  audit::SceneFuzzOptions options;
  set_common(options, arguments.common);
  options.noli = audit::noli_as_subject(interrupted());
  return run_fuzzer("fuzz scenes", "fuzz-scenes", output, options, audit::fuzz_scenes);
}

/// A saved scene again, as it is or made smaller.
ExitCode replay(const ScenesArguments& arguments) {
  const fs::path file = arguments.replay.saved();
  const Output output(arguments.common.results, {file});
  if (arguments.wrong_place && arguments.replay.minimise)
    throw UsageError("--wrong-place: a scene that is wrong somewhere is not minimised; use it with --replay");
  if (arguments.wrong_place && !arguments.wrong_place->starts_with('/'))
    throw UsageError("--wrong-place " + *arguments.wrong_place + ": expected a place of a scene, as in /bodies/0/mesh");
  if (arguments.replay.minimise) require_writable_folder(arguments.common.out, "--out");
  const audit::GeneratedScene given{audit::read_saved_scene(file), arguments.wrong_place};
  const auto [scene, judgement] =
      audit::replay_scene(given, arguments.replay.minimise.has_value(), audit::noli_as_subject(interrupted()));
  std::optional<fs::path> saved;
  if (judgement.difference && arguments.replay.minimise) {
    saved = fs::path(arguments.common.out) / (file.stem().string() + "-minimised.json");
    make_writable_folder(arguments.common.out, "--out");
    require_output_files({{"--out", *saved}}, {file}, true);
    write_file(*saved, scene.dump(2) + '\n');
  }
  return tell_replay(output,
                     {.unknown = judgement.stopped || interrupted(),
                      .difference = judgement.difference,
                      .saved = saved,
                      .facts = audit::scene_facts(judgement),
                      .pairs = {"end", "verified", "resumed"}},
                     "file");
}

}  // namespace

Command add_fuzz_scenes(CLI::App& fuzz_app) {
  CLI::App* const command =
      fuzz_app.add_subcommand("scenes", "Extreme and invalid scenes: simulate, verify, check, resume");
  command->footer(scenes_footer);
  const auto arguments = std::make_shared<ScenesArguments>();
  add_fuzz_options(*command, arguments->common, "scenes");
  add_replay_options(*command, arguments->replay, "scene", "SCENE.json", {});
  command
      ->add_option("--wrong-place", arguments->wrong_place,
                   "With --replay: the scene is wrong there, as in /bodies/0/mesh")
      ->type_name("PLACE");
  return {command, [arguments] { return arguments->replay.given() ? replay(*arguments) : fuzz(*arguments); }};
}

}  // namespace noli::app
