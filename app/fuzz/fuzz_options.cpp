// SPDX-License-Identifier: Apache-2.0
#include "app/fuzz/fuzz_options.h"

#include <cstdio>
#include <limits>
#include <system_error>

#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/fuzz/save_finding.h"
#include "certify/proofs/checker.h"
#include "certify/result_file.h"

namespace noli::app {

void add_fuzz_options(CLI::App& command, FuzzArgumentsInCommon& arguments, const std::string& what) {
  command
      .add_option("--for", arguments.duration,
                  "Stop after this time, then shrink findings: 500ms, 60s, 5m, 1h (60s, without --count)")
      ->type_name("TIME");
  command.add_option("--count", arguments.limits.count, "Stop after this many " + what)
      ->check(whole_number(1, std::uint64_t{1} << 60))
      ->type_name("N");
  command.add_option("--seed", arguments.limits.seed, "Seed of the " + what)
      ->capture_default_str()
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("S");
  add_threads_option(command, arguments.limits.threads);
  command
      .add_option("--corpus", arguments.corpus,
                  "Folder of " + what + " that reached something new: judged first, then extended")
      ->type_name("DIR");
  command.add_option("--out", arguments.out, "Folder for findings, created for the first one")
      ->capture_default_str()
      ->type_name("DIR");
  add_output_options(command, arguments.results);
}

void add_replay_options(CLI::App& command, ReplayArguments& arguments, const std::string& what, const std::string& type,
                        std::vector<std::string> excluded) {
  CLI::Option* const replay =
      command.add_option("--replay", arguments.replay, "Judge this saved " + what + " again instead")->type_name(type);
  CLI::Option* const minimise =
      command.add_option("--minimise", arguments.minimise, "Shrink this saved " + what + " into --out instead")
          ->type_name(type);
  replay->excludes(minimise);
  excluded.insert(excluded.end(), {"--count", "--for", "--seed", "--corpus"});
  for (const std::string& name : excluded) {
    replay->excludes(command.get_option(name));
    minimise->excludes(command.get_option(name));
  }
}

std::filesystem::path minimised_folder(const FuzzArgumentsInCommon& arguments, const std::filesystem::path& saved) {
  const auto name = std::filesystem::absolute(saved / "").lexically_normal().parent_path().filename();
  return audit::unused(std::filesystem::path(arguments.out) / (name.string() + "-minimised"));
}

std::vector<std::filesystem::path> saved_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;  // whoever reads the folder says what is wrong with it
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) files.push_back(entry.path());
  return files;
}

Output begin_fuzzing(FuzzArgumentsInCommon& arguments, const std::vector<std::filesystem::path>& inputs) {
  if (arguments.duration || !arguments.limits.count) {
    arguments.limits.time_limit = parse_duration(arguments.duration.value_or("60s"), "--for");
  }
  arguments.limits.stop = &interrupted();
  Output output(arguments.results, inputs);
  require_writable_folder(arguments.out, "--out");
  return output;
}

void set_common(audit::FuzzSettings& settings, const FuzzArgumentsInCommon& arguments) {
  settings.limits = arguments.limits;
  settings.out = arguments.out;
  settings.corpus = arguments.corpus;
  if (arguments.corpus) make_writable_folder(*arguments.corpus, "--corpus");
}

void note_missing_verified_checker() {
  if (!has_checker(Checker::verified)) std::fputs("noli: noli_check_verified was not found and is skipped\n", stderr);
}

ExitCode tell_replay(const Output& output, const audit::ReplayResult& judged, const char* place) {
  const Json json = audit::replay_json(judged, place);
  output.write("fuzz-replay", audit::replay_answer(json, judged), json);
  return fuzz_exit_code(judged.unknown, judged.difference.has_value());
}

}  // namespace noli::app
