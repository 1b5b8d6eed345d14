// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <utility>

#include "app/commands.h"
#include "app/options.h"
#include "app/verify/verdict.h"
#include "certify/shards/request_json.h"
#include "certify/shards/shards.h"

namespace noli::app {
namespace {

constexpr const char* merge_footer =
    "The verdict, the JSON (except \"timing\") and the proof are the same as from one process that verifies "
    "everything. The frames, or the run, must still have the names that `noli verify --shard` was given. No step is "
    "decided again. A shard that is missing, damaged, or of other files is an error.\n"
    "Examples:\n"
    "  noli verify 'frames/*.ply' --shard 1/2 -o shards\n"
    "  noli verify 'frames/*.ply' --shard 2/2 -o shards\n"
    "  noli merge shards --json verdict.json --proof all.noli\n";

struct MergeArguments {
  std::filesystem::path folder;
  std::optional<std::filesystem::path> proof;
  bool check = true;
  int threads = 0;
  VerdictOutputs outputs;
  std::string time_limit;
};

ExitCode run(const MergeArguments& arguments) {
  const auto deadline = begin_work(arguments.time_limit);
  VerifyWork request = request_of_shards(arguments.folder);
  if (arguments.proof && !are_proved(request)) {
    throw UsageError("--proof: the shards were made with --no-check, without proofs; expected shards with proofs");
  }
  request.proof = arguments.proof;
  request.check = arguments.check && request.check;
  request.threads = arguments.threads;
  request.deadline = deadline;
  std::vector<std::filesystem::path> inputs = request.frames;
  inputs.push_back(arguments.folder / "request.json");
  if (request.ignore) inputs.push_back(*request.ignore);
  std::error_code error;  // what cannot be listed is an error where it is read
  for (const auto& entry : std::filesystem::directory_iterator(arguments.folder, error)) {
    if (entry.path().extension() == ".shard") inputs.push_back(entry.path());
  }
  const Output output(arguments.outputs.results, inputs, files_of(request, arguments.outputs));
  return answer(request, arguments.outputs, output);
}

}  // namespace

Command add_merge(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("merge", "Join what `noli verify --shard` decided into one verdict");
  command->footer(merge_footer);
  const auto arguments = std::make_shared<MergeArguments>();
  command->add_option("shards", arguments->folder, "The folder that the shards are in")
      ->required()
      ->type_name("SHARDS");
  command->add_option("--proof", arguments->proof, "Write the proof to this file, for `noli check`")->type_name("OUT");
  command->add_flag_callback(
      "--no-check", [arguments] { arguments->check = false; }, "Skip the checker: the verdict is then no_contact");
  add_output_options(*command, arguments->outputs.results);
  command->add_option("--claim-out", arguments->outputs.claim_out, "Write the claim to this file")
      ->type_name("CLAIM.json");
  command->add_option("--junit", arguments->outputs.junit, "Write a JUnit file, with a test case for each step")
      ->type_name("OUT.xml");
  command->add_flag("--github", arguments->outputs.github, "Print annotations for GitHub Actions above the result")
      ->excludes(command->get_option("--porcelain"));
  add_threads_option(*command, arguments->threads);
  add_time_limit_option(*command, arguments->time_limit);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
