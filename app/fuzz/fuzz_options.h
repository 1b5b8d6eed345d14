// SPDX-License-Identifier: Apache-2.0
//
// The options that the fuzzers of motions, scenes and proofs have in common, in the same words, and their verdicts.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/exit_code.h"
#include "app/output.h"
#include "app/progress.h"
#include "audit/fuzz/fuzzing.h"
#include "certify/stopwatch.h"

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
struct AgainArguments {
  std::optional<std::string> replay, minimise;

  bool given() const { return replay || minimise; }
  const std::string& saved() const { return replay ? *replay : *minimise; }
};

/// `what` was saved: "motion"; `type`: "FOLDER". After add_fuzz_options and whatever else has to do with fuzzing:
/// options of these names exclude both.
void add_again_options(CLI::App& command, AgainArguments& arguments, const std::string& what, const std::string& type,
                       std::vector<std::string> excluded);

/// "NAME-minimised" in --out, for a saved folder NAME, so that nothing is overwritten (audit/fuzz/finding_name.h).
std::filesystem::path minimised_folder(const FuzzArgumentsInCommon& arguments, const std::filesystem::path& saved);

/// The files in a saved folder, which --json may not overwrite; none if it is not there.
std::vector<std::filesystem::path> saved_files(const std::filesystem::path& folder);

/// Makes limits of what was given: a minute if nothing was. Throws UsageError.
void settle_limits(FuzzArgumentsInCommon& arguments);

/// The folder of --corpus, made if it is not there. Throws UsageError.
std::optional<std::filesystem::path> corpus_folder(const FuzzArgumentsInCommon& arguments);

/// Copies the limits, --out and --corpus. Throws UsageError.
void set_common(audit::FuzzSettings& settings, const FuzzArgumentsInCommon& arguments);

/// Of its verdict.
ExitCode fuzz_exit_code(const audit::FuzzTotals& report);

/// Of something that was judged again: "undecided", "finding", "no_finding".
const char* again_verdict(bool unknown, bool finding);
ExitCode again_exit_code(bool unknown, bool finding);

/// Runs fuzz(options), shows how far it is as "fuzz ITEMS", and writes a result with this schema: answer_of(report,
/// seconds) and json_of(report, seconds). Throws WriteError when not all that was found could be saved.
template <class Options, class Fuzz, class AnswerOf, class JsonOf>
ExitCode run_fuzzer(const char* items, const char* schema, const Output& output, Options& options, const Fuzz& fuzz,
                    const AnswerOf& answer_of, const JsonOf& json_of) {
  const Stopwatch watch;
  const auto report = with_progress(items, [&](const auto& show) {
    options.limits.progress = show;
    return fuzz(options);
  });
  const double seconds = watch.seconds();
  output.write(schema, answer_of(report, seconds), json_of(report, seconds));
  report.not_saved.require_nothing();
  return fuzz_exit_code(report);
}

}  // namespace noli::app
