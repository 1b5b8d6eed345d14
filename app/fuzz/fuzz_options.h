// SPDX-License-Identifier: Apache-2.0
//
// What the commands of all fuzzers share: options, the start of a run, results and exit codes.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/exit_code.h"
#include "app/output.h"
#include "app/progress.h"
#include "audit/fuzz/finding_report.h"
#include "audit/fuzz/fuzzing.h"
#include "certify/json.h"
#include "certify/stopwatch.h"
#include "kernel/parallel.h"
#include "report/answer.h"

namespace noli::app {

/// --seed, --count, --for, --threads, --corpus, --out, and where results go.
struct FuzzArgumentsInCommon {
  audit::FuzzLimits limits;
  std::optional<std::string> duration, corpus;
  std::string out = "fuzz-findings";
  OutputOptions results;
};

/// `what` are the items: "motions".
void add_fuzz_options(CLI::App& command, FuzzArgumentsInCommon& arguments, const std::string& what);

/// --replay and --minimise: something that was saved, judged again instead of fuzzing.
struct ReplayArguments {
  std::optional<std::string> replay, minimise;

  bool given() const { return replay || minimise; }
  const std::string& saved() const { return replay ? *replay : *minimise; }
};

/// `what` was saved: "motion"; `type`: "FOLDER". After add_fuzz_options and whatever else has to do with fuzzing:
/// options of these names exclude both.
void add_replay_options(CLI::App& command, ReplayArguments& arguments, const std::string& what, const std::string& type,
                        std::vector<std::string> excluded);

/// "NAME-minimised" in --out, for a saved folder NAME, so that nothing is overwritten (audit/fuzz/save_finding.h).
std::filesystem::path minimised_folder(const FuzzArgumentsInCommon& arguments, const std::filesystem::path& saved);

/// The files in a saved folder, which --json may not overwrite; none if it is not there.
std::vector<std::filesystem::path> saved_files(const std::filesystem::path& folder);

/// Settles the limits (one minute if none is given) and checks that results and findings can be written. Throws
/// UsageError.
Output begin_fuzzing(FuzzArgumentsInCommon& arguments, const std::vector<std::filesystem::path>& inputs);

/// Copies the limits, --out and --corpus, whose folder is made if it is not there. Throws UsageError.
void set_common(audit::FuzzSettings& settings, const FuzzArgumentsInCommon& arguments);

/// Reports on standard error when noli_check_verified is missing.
void note_missing_verified_checker();

/// The exit code of a run, or of a saved item that was judged again.
inline ExitCode fuzz_exit_code(bool undecided, bool finding) {
  return undecided ? ExitCode::undecided : finding ? ExitCode::refuted : ExitCode::holds;
}

/// Writes it as a result of the schema "fuzz-replay". `place`: as in replay_json().
ExitCode tell_replay(const Output& output, const audit::ReplayResult& judged, const char* place = "folder");

/// Runs fuzz(options) with a progress bar called `work`, and writes the result under this schema. Argument-dependent
/// lookup finds fuzz_json(options, report), fuzz_text(options, report) and fuzz_pairs(report), beside the fuzzer in
/// audit/fuzz/. Adds `timing`. Throws WriteError if a finding could not be saved.
template <class Options, class Fuzz>
ExitCode run_fuzzer(const char* work, const char* schema, const Output& output, Options& options, const Fuzz& fuzz) {
  const Stopwatch watch;
  const auto report = with_progress(work, [&](const auto& show) {
    options.limits.progress = show;
    return fuzz(options);
  });
  const double seconds = watch.seconds();
  const int threads = options.limits.threads;
  Json json = fuzz_json(options, report);
  json["timing"] = {{"seconds", seconds}, {"threads", threads > 0 ? threads : hardware_threads()}};
  report::Answer answer(json, fuzz_pairs(report));
  answer.text = fuzz_text(options, report) + fmt::format("Time: {:.1f} s.\n", seconds);
  output.write(schema, answer, json);
  report.not_saved.require_nothing();
  return fuzz_exit_code(report.undecided(), report.findings_total > 0);
}

}  // namespace noli::app
