// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
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
#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/queries/saved_query.h"
#include "audit/fuzz/save_finding.h"
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

// --- single files ----------------------------------------------------------------------------------------------------

/// Queries of a file, and what each of them shows.
class OneFile {
 public:
  OneFile(const FuzzArguments& arguments, const fs::path& file)
      : arguments_(arguments), saved_(audit::read_saved_queries(file)) {
    const AnyQuery& first = saved_.at(0).query;
    if (!arguments_.asks_a_library()) return;
    if (!audit::is_library_query({first.pair, first.dimension})) {
      throw InputError(file.string(), "", "a library is asked about a vertex and a face or two edges in 3D");
    }
    audit::require_ccd_library(arguments_.asked.path, arguments_.asked.host);
    knows_times_ = audit::knows_times(arguments_.asked);
    std::vector<AnyQuery> queries;
    for (const audit::SavedQuery& saved : saved_) queries.push_back(saved.query);
    found_ = audit::faults_of(arguments_.asked, first.pair, queries, knows_times_);
  }

  /// Of how many queries there is an answer.
  std::size_t asked() const { return arguments_.asks_a_library() ? found_.asked : saved_.size(); }

  const std::vector<audit::SavedQuery>& queries() const { return saved_; }

  /// In words, one line each; nothing for what is right.
  std::vector<std::string> differences() const {
    std::vector<std::string> result;
    for (const auto& fault : found_.faults) {
      if (fault) result.push_back(fault->words);
    }
    if (arguments_.asks_a_library()) return result;
    for (const audit::SavedQuery& saved : saved_) {
      const auto found = audit::replay(saved.query, saved.probe);
      result.insert(result.end(), found.begin(), found.end());
    }
    return result;
  }

  /// What fails, made simpler; equal ones once.
  std::vector<audit::Finding> minimised() const {
    std::vector<audit::Finding> result;
    const auto keep = [&](audit::Finding finding) {
      const auto same = [&](const audit::Finding& other) { return other.shrunk == finding.shrunk; };
      if (std::none_of(result.begin(), result.end(), same)) result.push_back(std::move(finding));
    };
    for (std::size_t i = 0; i < saved_.size() && !interrupted(); ++i) {
      if (!arguments_.asks_a_library()) {
        auto finding = audit::shrunk_finding(saved_[i].query, saved_[i].probe);
        if (!finding) continue;
        finding->index = i;
        keep(std::move(*finding));
      } else if (found_.faults[i]) {
        const auto shrunk =
            audit::shrink_for_library(arguments_.asked, saved_[i].query, *found_.faults[i], knows_times_);
        audit::Finding finding;
        finding.index = i;
        finding.query = saved_[i].query;
        finding.shrunk = shrunk.query;
        finding.difference = shrunk.found.words;
        finding.truth = shrunk.found.kind;
        keep(std::move(finding));
      }
    }
    return result;
  }

 private:
  const FuzzArguments& arguments_;
  std::vector<audit::SavedQuery> saved_;
  bool knows_times_ = false;
  audit::FaultsFound found_;
};

/// What a replay says where the library hung so often that it was not asked any more.
std::string not_asked_text(const OneFile& file) {
  const std::size_t left = file.queries().size() - file.asked();
  return left == 0
             ? ""
             : fmt::format("Skipped after too many hangs or an interruption: {} of {}.\n", left, file.queries().size());
}

/// What a replay found, in all files.
struct Replayed {
  std::vector<std::string> differences;
  std::size_t queries = 0, not_asked = 0;
  bool probe = false;
  std::string text;
};

Replayed replay_files(const FuzzArguments& arguments) {
  Replayed all;
  const bool one = arguments.replay.size() == 1;
  for (const std::string& path : arguments.replay) {
    const OneFile file(arguments, path);
    for (const std::string& difference : file.differences()) {
      all.differences.push_back(one ? difference : on_one_line(path) + ": " + difference);
      all.text += all.differences.back() + '\n';
    }
    all.queries += file.asked();
    all.not_asked += file.queries().size() - file.asked();
    all.probe = all.probe || file.queries().at(0).probe.has_value();
    all.text += not_asked_text(file);
    if (interrupted()) break;
  }
  return all;
}

/// Decides the queries of files again. Throws InputError.
ExitCode replay(const FuzzArguments& arguments) {
  const Output output(arguments.results, inputs(arguments));
  const Replayed found = replay_files(arguments);
  const auto& [differences, queries, not_asked, probe, text] = found;
  const bool undecided = interrupted() || (not_asked > 0 && differences.empty());
  const char* const word = undecided                    ? "undecided"
                           : !differences.empty()       ? "finding"
                           : arguments.asks_a_library() ? "no_finding"
                                                        : "no_difference";
  const Json json = {{"verdict", word},        {"queries", queries},
                     {"not_asked", not_asked}, {"findings", differences.size()},
                     {"probe", probe},         {"differences", differences}};
  report::Answer answer(json, {"queries", "findings"});
  answer.text = text;
  output.write("fuzz-replay", answer, json);
  return fuzz_exit_code(undecided, !differences.empty());
}

/// "queries-edge-edge.csv" gives "queries-edge-edge-query3-minimised.csv", beside it or in the folder of --out.
fs::path minimised_name(const FuzzArguments& arguments, std::size_t query) {
  const fs::path file = *arguments.minimise;
  const fs::path folder = arguments.out_given ? fs::path(arguments.out) : file.parent_path();
  return folder / fmt::format("{}-query{}-minimised.csv", file.stem().string(), query);
}

void save(const audit::Finding& finding, const fs::path& file, bool with_probe, const std::string& command) {
  std::vector<std::string> comments = {"# " + on_one_line(finding.difference), "# " + command};
  if (with_probe) comments.push_back(audit::probe_line(finding.shrunk, finding.probe));
  audit::save_query(file, finding.shrunk, finding.truth != ContactKind::apart, comments);
}

ExitCode minimise(const FuzzArguments& arguments) {
  const Output output(arguments.results, inputs(arguments));
  const OneFile file(arguments, *arguments.minimise);
  if (arguments.out_given) make_writable_folder(arguments.out, "--out");
  require_writable_file(minimised_name(arguments, 1), arguments.out_given ? "--out" : "--minimise");
  const std::vector<audit::Finding> findings = file.minimised();
  const std::size_t queries = file.queries().size();
  const bool undecided = interrupted();
  const char* const word = undecided ? "undecided" : findings.empty() ? "nothing_fails" : "finding";
  Json json = {{"verdict", word}, {"queries", queries}, {"findings", findings.size()}, {"reports", Json::array()}};
  report::Answer answer(json, {"queries", "findings"});
  for (const audit::Finding& finding : findings) {
    const fs::path result = audit::unused(minimised_name(arguments, finding.index + 1));
    const std::string command = replay_command(arguments, result);
    save(finding, result, file.queries()[finding.index].probe.has_value(), command);
    answer.text += fmt::format("query {}: {}; {} different numbers; saved as {}\n  again: {}\n", finding.index + 1,
                               finding.difference, audit::distinct_coordinates(finding.shrunk),
                               on_one_line(result.string()), command);
    json["reports"].push_back({{"query", finding.index + 1},
                               {"difference", finding.difference},
                               {"distinct_coordinates", audit::distinct_coordinates(finding.shrunk)},
                               {"file", result.string()},
                               {"command", command}});
  }
  output.write("fuzz-replay", answer, json);
  return fuzz_exit_code(undecided, !findings.empty());
}

// --- runs ------------------------------------------------------------------------------------------------------------

/// Runs a fuzzer with the options that both kinds have.
template <class Options, class Fuzz, class JsonOf, class TextOf>
ExitCode run(const FuzzArguments& arguments, Options options, const Output& output, const FuzzResultNames& names,
             const Fuzz& fuzz, const JsonOf& json_of, const TextOf& text_of) {
  set_common(options, arguments);
  options.max_findings = arguments.max_findings;
  options.command = [&arguments](const fs::path& file) { return replay_command(arguments, file); };
  return run_fuzzer(
      names, output, options, fuzz, [&](const auto& report) { return json_of(options, report); },
      [&](const auto& report) { return text_of(options, report); });
}

ExitCode run(FuzzArguments& arguments) {
  settle_library(arguments);
  if (!arguments.replay.empty()) return replay(arguments);
  if (arguments.minimise) return minimise(arguments);
  const Output output = begin_fuzzing(arguments, inputs(arguments));
  if (!arguments.asks_a_library()) {
    return run(arguments, audit::QueryFuzzOptions(), output,
               {"fuzz queries", "fuzz-queries", {"queries", "findings", "seed"}}, audit::fuzz_queries, audit::fuzz_json,
               audit::fuzz_text);
  }
  audit::LibraryFuzzOptions options;
  options.asked = arguments.asked;
  options.first_only = arguments.first_only;
  return run(arguments, options, output, {"fuzz queries", "fuzz-library-queries", audit::library_fuzz_pairs()},
             audit::fuzz_library, audit::library_fuzz_json, audit::library_fuzz_text);
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
