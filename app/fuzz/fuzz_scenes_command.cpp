// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/fuzz/fuzz_options.h"
#include "app/output.h"
#include "app/output_files.h"
#include "app/process.h"
#include "audit/fuzz/scenes/fuzz_scenes.h"
#include "certify/json.h"
#include "certify/process/run_program.h"
#include "certify/process/this_program.h"
#include "certify/result_file.h"
#include "trajectory/text.h"
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

/// `noli` itself, as a program of its own. Throws std::system_error when the checker that it starts is not there: each
/// scene would be a finding.
audit::RunNoli this_program() {
  require_startable(beside_this_program("noli_check").string());
  return [noli = this_program_file().string()](const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {noli};
    words.insert(words.end(), arguments.begin(), arguments.end());
    ProgramLimits limits;
    limits.stop = stop_by(&interrupted());
    limits.time = std::chrono::seconds(120);
    return run_program(std::move(words), limits);
  };
}

Json report_json(const ScenesArguments& arguments, const audit::SceneFuzzReport& report) {
  Json json = {{"verdict", report.verdict()}, {"seed", arguments.common.limits.seed},
               {"scenes", report.items},      {"findings", report.findings_total},
               {"verified", report.verified}, {"resumed", report.resumed}};
  json["ends"] = Json::object();
  for (const auto& [generator, ends] : report.ends) {
    for (const auto& [end, count] : ends) json["ends"][generator][end] = count;
  }
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) json["reports"].push_back(finding_json(finding, "file"));
  return json;
}

std::string report_text(const ScenesArguments& arguments, const audit::SceneFuzzReport& report) {
  std::string text;
  for (const auto& finding : report.findings) text += finding_line(finding, "scene");
  for (const auto& [generator, ends] : report.ends) {
    text += fmt::format("  {:17}", generator);
    for (const auto& [end, count] : ends) text += fmt::format(" {} {};", end, count);
    text += '\n';
  }
  if (arguments.common.corpus) text += fmt::format("Corpus: {} scenes.\n", report.corpus_size);
  return text;
}

ExitCode fuzz(ScenesArguments& arguments) {
  if (arguments.wrong_place) throw UsageError("--wrong-place goes with --replay or --minimise");
  const Output output = begin_fuzzing(arguments.common, {});
  audit::SceneFuzzOptions options;
  set_common(options, arguments.common);
  options.noli = this_program();
  return run_fuzzer(
      {"fuzz scenes", "fuzz-scenes", {"scenes", "findings", "verified", "resumed", "seed"}}, output, options,
      audit::fuzz_scenes, [&](const auto& report) { return report_json(arguments, report); },
      [&](const auto& report) { return report_text(arguments, report); });
}

/// A saved scene again, as it is or made smaller.
ExitCode replay(const ScenesArguments& arguments) {
  const fs::path file = arguments.replay.saved();
  const Output output(arguments.common.results, {file});
  if (arguments.replay.minimise) require_writable_folder(arguments.common.out, "--out");
  if (arguments.wrong_place && !arguments.wrong_place->starts_with('/'))
    throw UsageError("--wrong-place " + *arguments.wrong_place + ": expected a place of a scene, as in /bodies/0/mesh");
  audit::SceneJson scene = audit::read_saved_scene(file);
  const audit::RunNoli noli = this_program();
  const auto judge = [&](const audit::SceneJson& candidate) {
    return audit::judge_scene({candidate, arguments.wrong_place}, noli);
  };
  audit::SceneJudgement judgement = judge(scene);
  std::optional<fs::path> saved;
  if (judgement.difference && arguments.replay.minimise) {
    const std::string kind(audit::kind_of(*judgement.difference));
    scene = audit::minimise(
        scene, [&](const audit::SceneJson& candidate) { return audit::is_of_kind(judge(candidate).difference, kind); },
        1000);
    if (audit::SceneJudgement last = judge(scene); last.difference) judgement = std::move(last);
    saved = fs::path(arguments.common.out) / (file.stem().string() + "-minimised.json");
    make_writable_folder(arguments.common.out, "--out");
    require_output_files({{"--out", *saved}}, {file}, true);
    write_file(*saved, scene.dump(2) + '\n');
  }
  return tell_replay(
      output,
      {.unknown = judgement.stopped || interrupted(),
       .difference = judgement.difference,
       .saved = saved,
       .facts = {{"end", judgement.end}, {"verified", judgement.verified}, {"resumed", judgement.resumed}},
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
                   "With --replay or --minimise: the scene is wrong there, as in /bodies/0/mesh")
      ->type_name("PLACE");
  return {command, [arguments] { return arguments->replay.given() ? replay(*arguments) : fuzz(*arguments); }};
}

}  // namespace noli::app
