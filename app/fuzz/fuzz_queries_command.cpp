// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "app/audit/library_options.h"
#include "app/commands.h"
#include "app/fuzz/fuzz_options.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/fuzz/queries/fuzz_queries_report.h"
#include "audit/fuzz/queries/replay_queries.h"
#include "audit/fuzz/queries/saved_query.h"
#include "certify/result_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* queries_footer =
    "Makes adversarial queries backwards from a known contact. The kernel and a slow, independent oracle "
    "decide each: contact, distance within a bound and when first, and the failure time of a certificate for "
    "two of its points.\n"
    "\n"
    "With --library, a third-party library is asked instead, and the kernel is the truth. The library has the "
    "functions of noli/ccd_plugin.h and runs in a separate process. Findings are missed contacts, late or absent "
    "times, failures, crashes and hangs; of an --exact library also false positives and early times. Each finding is "
    "shrunk and saved as a file that `noli ccd` and `noli audit ccd` read, labelled with the truth and with the "
    "command that asks it again.\n"
    "\n"
    "With --count the result depends only on the seed and, if there is one, the corpus. Exit codes: 0 no finding; 1 "
    "findings; 2 interrupted; 3 a library or file is at fault.\n"
    "Examples:\n"
    "  noli fuzz queries --library ./mine.so --for 60s --tolerance 1e-6\n"
    "  noli fuzz queries --library ./mine.so --minimise queries-edge-edge.csv\n"
    "  noli fuzz queries --library ./mine.so --replay fuzz-findings/*.csv\n"
    "  gdb --args noli fuzz queries --library ./mine.so --replay crash.csv --in-process\n"
    "  noli fuzz queries --for 60s --seed 1                the kernel itself\n"
    "  noli fuzz queries --count 1000000 --threads 2 --corpus corpus --json result.json\n";

struct FuzzArguments : LibraryArguments, FuzzArgumentsInCommon {
  std::vector<std::string> replay;
  std::optional<std::string> minimise;
  std::size_t max_findings = audit::FuzzSettings().max_findings;
  bool out_given = false;
};

/// "noli fuzz queries --library ./mine.so --tolerance 1e-06 --replay FILE"
std::string replay_command(const FuzzArguments& arguments, const fs::path& file) {
  std::string command = "noli fuzz queries";
  for (const std::string& word : library_words(arguments)) command += " " + audit::quoted(word);
  return on_one_line(command + " --replay " + audit::quoted(file.string()));
}

std::vector<fs::path> inputs(const FuzzArguments& arguments) {
  std::vector<fs::path> files;
  if (arguments.asks_a_library()) files.push_back(arguments.asked.path);
  files.insert(files.end(), arguments.replay.begin(), arguments.replay.end());
  if (arguments.minimise) files.emplace_back(*arguments.minimise);
  return files;
}

/// nullptr: the kernel is asked.
const audit::LibraryUnderTest* library_of(const FuzzArguments& arguments) {
  return arguments.asks_a_library() ? &arguments.asked : nullptr;
}

ExitCode tell_queries(const Output& output, const audit::ReplayedQueries& found) {
  report::Answer answer(found.json, {"queries", "findings"});
  answer.text = found.text;
  output.write("fuzz-replay", answer, found.json);
  return fuzz_exit_code(found.undecided, found.finding);
}

/// Decides the queries of files again. Throws InputError.
ExitCode replay(const FuzzArguments& arguments) {
  const Output output(arguments.results, inputs(arguments));
  return tell_queries(output, audit::replay_files(arguments.replay, library_of(arguments), interrupted()));
}

/// Shrinks the failing queries of a file, and saves them beside it or in the folder of --out.
ExitCode minimise(const FuzzArguments& arguments) {
  const Output output(arguments.results, inputs(arguments));
  const audit::SavedQueryFile file(*arguments.minimise, library_of(arguments));
  const fs::path folder = arguments.out_given ? fs::path(arguments.out) : file.path().parent_path();
  if (arguments.out_given) make_writable_folder(arguments.out, "--out");
  require_writable_file(audit::minimised_name(file.path(), folder, 1), arguments.out_given ? "--out" : "--minimise");
  const auto command = [&](const fs::path& saved) { return replay_command(arguments, saved); };
  return tell_queries(output, audit::minimise_file(file, folder, command, interrupted()));
}

/// Runs a fuzzer with the options that both kinds have.
template <class Options, class Fuzz>
ExitCode run(const FuzzArguments& arguments, Options options, const Output& output, const char* schema,
             const Fuzz& fuzz) {
  set_common(options, arguments);
  options.max_findings = arguments.max_findings;
  options.command = [&arguments](const fs::path& file) { return replay_command(arguments, file); };
  return run_fuzzer("fuzz queries", schema, output, options, fuzz);
}

ExitCode run(FuzzArguments& arguments) {
  settle_library(arguments);
  if (!arguments.replay.empty()) return replay(arguments);
  if (arguments.minimise) return minimise(arguments);
  const Output output = begin_fuzzing(arguments, inputs(arguments));
  if (!arguments.asks_a_library()) {
    return run(arguments, audit::QueryFuzzOptions(), output, "fuzz-queries", audit::fuzz_queries);
  }
  audit::LibraryFuzzOptions options;
  options.asked = arguments.asked;
  options.first_only = arguments.first_only;
  return run(arguments, options, output, "fuzz-library-queries", audit::fuzz_library);
}

}  // namespace

Command add_fuzz_queries(CLI::App& fuzz) {
  CLI::App* const command =
      fuzz.add_subcommand("queries", "Single queries: a library against the truth, or the kernel against its oracle");
  command->footer(queries_footer);
  const auto arguments = std::make_shared<FuzzArguments>();
  add_fuzz_options(*command, *arguments, "queries");
  command->add_option("--max-findings", arguments->max_findings, "Shrink and save at most N")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str()
      ->type_name("N");
  add_library_options(*command, *arguments, "the kernel");
  command
      ->add_option("--late-tolerance", arguments->asked.late_tolerance,
                   "Times that are late by at most this part of the step are not findings")
      ->check(is_not_negative())
      ->capture_default_str()
      ->type_name("T")
      ->needs(command->get_option("--library"));
  CLI::Option* const out = command->get_option("--out");
  CLI::Option* const replay =
      command->add_option("--replay", arguments->replay, "Decide the queries of these files again instead")
          ->type_name("FILE");
  command
      ->add_flag("--in-process", arguments->asked.host.in_process,
                 "Call the library in this process, for a debugger or a sanitizer: nothing protects noli from it")
      ->needs(replay)
      ->needs(command->get_option("--library"))
      ->excludes(command->get_option("--sandbox"))
      ->excludes(command->get_option("--query-limit"))
      ->excludes(command->get_option("--memory-limit"));
  CLI::Option* const smaller =
      command
          ->add_option("--minimise", arguments->minimise,
                       "Instead, shrink the failing queries of this file, and save them next to it or in --out")
          ->type_name("FILE");
  replay->excludes(smaller)->excludes(out);
  for (const char* const name :
       {"--for", "--count", "--seed", "--corpus", "--max-findings", "--threads", "--first-only"}) {
    replay->excludes(command->get_option(name));
    smaller->excludes(command->get_option(name));
  }
  return {command, [arguments, out] {
            arguments->out_given = out->count() > 0;
            return run(*arguments);
          }};
}

}  // namespace noli::app
