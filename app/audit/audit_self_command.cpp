// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/numerics/self.h"
#include "audit/numerics/self_report.h"
#include "certify/process/this_program.h"
#include "certify/result_file.h"
#include "certify/stopwatch.h"

namespace noli::app {
namespace {

constexpr const char* self_footer =
    "Runs everything noli can check about itself: the self-test of its rounding, the labelled queries in $NOLI_DATA, "
    "each fuzzer for a while, and proofs with each installed checker. What cannot run is reported as skipped and does "
    "not count as held.\n"
    "\n"
    "Exit codes: 0 all that ran held; 1 something failed; 2 interrupted or, with --require-all, something "
    "was skipped.\n"
    "Examples:\n"
    "  noli audit self\n"
    "  noli audit self --for 10m --data data --scenes scenes --require-all --json self.json\n";

struct SelfArguments {
  audit::SelfOptions options;
  std::string fuzz_time = "60s", scene_time = "5s", scenes = "scenes", out = "self-findings";
  std::optional<std::string> program, data;
  OutputOptions results;
};

/// What NOLI_DATA names, unless the command line does.
std::optional<std::filesystem::path> data_folder(const std::optional<std::string>& given) {
  if (given) return *given;
  const char* const named = std::getenv("NOLI_DATA");
  if (named == nullptr || *named == '\0') return std::nullopt;
  return named;
}

ExitCode run(SelfArguments& arguments) {
  audit::SelfOptions& options = arguments.options;
  options.fuzz_time = parse_duration(arguments.fuzz_time, "--for");
  options.scene_time = parse_duration(arguments.scene_time, "--scene-time");
  if (arguments.program) require_program(*arguments.program, "--program");
  options.program = arguments.program ? std::filesystem::absolute(*arguments.program) : this_program_file();
  options.data = data_folder(arguments.data);
  options.scenes = arguments.scenes;
  options.out = arguments.out;
  options.stop = &interrupted();
  const Output output(arguments.results, {options.program});
  require_writable_folder(arguments.out, "--out");
  options.begun = [](const std::string& part) { std::fputs(fmt::format("noli: {}\n", part).c_str(), stderr); };
  const Stopwatch watch;
  const audit::SelfReport report = audit::audit_self(options);
  const double seconds = watch.seconds();
  const Json json = audit::self_json(options, report, seconds);
  output.write("audit-self", audit::self_answer(json, report, seconds), json);
  return exit_code_of(report.refuted(), report.holds(options.require_all));
}

}  // namespace

Command add_audit_self(CLI::App& audit) {
  CLI::App* const command = audit.add_subcommand("self", "Everything noli can check about itself, on one page");
  command->footer(self_footer);
  const auto arguments = std::make_shared<SelfArguments>();
  audit::SelfOptions& options = arguments->options;
  command->add_option("--for", arguments->fuzz_time, "Time of each fuzzer: 500ms, 60s, 10m")
      ->capture_default_str()
      ->type_name("TIME");
  command->add_option("--scene-time", arguments->scene_time, "Time of each scene of --scenes")
      ->capture_default_str()
      ->type_name("TIME");
  command->add_option("--seed", options.seed, "Seed of the fuzzers")
      ->capture_default_str()
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("S");
  command->add_option("--only", options.only, "Only these parts: rounding, labels, fuzz, proofs; separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(audit::self_groups), std::end(audit::self_groups))))
      ->type_name("PART");
  command->add_option("--data", arguments->data, "Folder with queries/*.csv [$NOLI_DATA]")
      ->check(CLI::ExistingDirectory)
      ->type_name("DIR");
  command->add_option("--scenes", arguments->scenes, "Folder with scenes, which are run in their short forms")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str()
      ->type_name("DIR");
  command->add_option("--program", arguments->program, "Run this `noli` program instead")
      ->check(CLI::ExistingFile)
      ->type_name("NOLI");
  command->add_option("--out", arguments->out, "Folder for findings, created for the first one")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_flag("--require-all", options.require_all, "Exit 2 when something was skipped");
  add_threads_option(*command, options.threads);
  add_output_options(*command, arguments->results);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
