// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <string>

#include "noli/app/commands.h"
#include "noli/app/duration.h"
#include "noli/app/interrupt.h"
#include "noli/app/options.h"
#include "noli/app/output.h"
#include "noli/app/progress.h"
#include "noli/audit/fuzz_queries.h"
#include "noli/kernel/parallel.h"
#include "noli/trajectory/error.h"
#include "noli/trajectory/query_csv.h"
#include "noli/trajectory/text.h"

namespace noli::app {
namespace {

constexpr const char* queries_footer =
    "Adversarial queries made backwards from a known contact, each decided by the kernel and by a slow independent "
    "oracle: contact, distance\n"
    "(within a bound or not, and when first), and the failure time of a certificate for two of its points. A "
    "difference "
    "is shrunk and saved as a\n"
    "file that `noli ccd` reads, labelled with the truth about contact; --replay asks it again. Exit 0: no difference; "
    "1: findings; 2: interrupted.\n"
    "With --count the result depends on the seed alone.\n"
    "Examples:\n"
    "  noli fuzz queries --for 60s --seed 1\n"
    "  noli fuzz queries --count 1000000 --threads 2 --out findings --json result.json\n"
    "  noli fuzz queries --replay findings/seed1-block7-index3-edge-edge.csv";

struct FuzzArguments {
  audit::FuzzOptions options;
  std::string duration = "60s";
  std::string out = "fuzz-findings";
  std::optional<std::string> replay;
  std::optional<std::string> json;
};

constexpr std::array<ContactKind, 4> kinds = {ContactKind::apart, ContactKind::touching, ContactKind::crossing,
                                              ContactKind::persistent};

const char* verdict(const audit::FuzzReport& report) {
  if (report.findings_total > 0) return "finding";
  return report.interrupted || report.queries == 0 ? "undecided" : "no_difference";
}

ExitCode exit_code(const audit::FuzzReport& report) {
  if (report.findings_total > 0) return ExitCode::refuted;
  return report.interrupted || report.queries == 0 ? ExitCode::undecided : ExitCode::holds;
}

Json answers_json(const std::array<std::uint64_t, 4>& answers) {
  Json json = Json::object();
  for (const ContactKind kind : kinds) json[std::string(name(kind))] = answers[static_cast<std::size_t>(kind)];
  return json;
}

Json finding_json(const audit::Finding& finding) {
  return {{"generator", finding.generator},   {"block", finding.block},       {"index", finding.index},
          {"difference", finding.difference}, {"truth", name(finding.truth)}, {"file", finding.file.string()}};
}

Json generator_json(const audit::GeneratorTally& generator) {
  return {{"name", generator.name},
          {"pair", name(generator.type.pair)},
          {"dimension", generator.type.dimension},
          {"answers", answers_json(generator.answers)}};
}

Json probes_json(const audit::ProbeTally& probes) {
  return {{"distance", {{"apart", probes.apart}, {"within", probes.within}}},
          {"failure_time",
           {{"failed", probes.failed}, {"failing", probes.failing}, {"never_failing", probes.never_failing}}}};
}

Json fuzz_json(const audit::FuzzOptions& options, const audit::FuzzReport& report, double seconds) {
  Json json = {{"verdict", verdict(report)},
               {"seed", options.seed},
               {"queries", report.queries},
               {"findings", report.findings_total},
               {"answers", answers_json(report.answers)}};
  json["probes"] = probes_json(report.probes);
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) json["reports"].push_back(finding_json(finding));
  json["generators"] = Json::array();
  for (const auto& generator : report.generators) json["generators"].push_back(generator_json(generator));
  json["stages"] = stages_json(report.stages);
  json["timing"] = {{"seconds", seconds}, {"threads", options.threads > 0 ? options.threads : hardware_threads()}};
  return json;
}

void append_generator(const audit::GeneratorTally& generator, std::string& text) {
  text += fmt::format("  {} ({}, {}D):", generator.name, name(generator.type.pair), generator.type.dimension);
  for (const ContactKind kind : kinds) {
    text += fmt::format(" {} {}", name(kind), generator.answers[static_cast<std::size_t>(kind)]);
  }
  text += '\n';
}

std::string fuzz_text(const audit::FuzzOptions& options, const audit::FuzzReport& report, double seconds) {
  std::string text = fmt::format("verdict {} queries {} findings {} seed {}\n", verdict(report), report.queries,
                                 report.findings_total, options.seed);
  const auto out = std::back_inserter(text);
  for (const auto& finding : report.findings) {
    fmt::format_to(out, "finding: {}, block {}, query {}: {}; {}\n", finding.generator, finding.block, finding.index,
                   finding.difference,
                   finding.file.empty() ? "not saved" : "saved as " + on_one_line(finding.file.string()));
  }
  text += "Answers of the oracle:\n";
  for (const auto& generator : report.generators) append_generator(generator, text);
  const audit::ProbeTally& probes = report.probes;
  fmt::format_to(out, "Distances: apart {} within {}. Certificates: failed {} failing {} never_failing {}.\n",
                 probes.apart, probes.within, probes.failed, probes.failing, probes.never_failing);
  text += "Stages:";
  for (const Stage stage : all_stages) fmt::format_to(out, " {} {}", name(stage), report.stages[stage]);
  fmt::format_to(out, "\nTime: {:.1f} s.\n", seconds);
  return text;
}

/// Share of the run that is done, by count or by time, whichever is further.
double share(const audit::FuzzOptions& options, const audit::FuzzProgress& progress) {
  if (options.count) return static_cast<double>(progress.queries) / static_cast<double>(*options.count);
  return progress.seconds / options.time_limit->count();
}

/// The line of a saved finding that says what it was asked beside contact, if the file has one.
std::optional<audit::SavedProbe> saved_probe(const std::string& text) {
  Lines lines(text);
  std::string_view line;
  while (lines.next(line)) {
    if (const auto saved = audit::parse_probe_line(line)) return saved;
  }
  return std::nullopt;
}

/// Decides the queries of a file again. Throws InputError.
ExitCode replay(const FuzzArguments& arguments) {
  const std::filesystem::path file = *arguments.replay;
  const auto kind = kind_from_file_name(file);
  if (!kind) throw InputError(file.string(), "", "its name tells no kind of query, such as edge-edge");
  const Output output(arguments.json, {file});
  const std::string text = read_whole_file(file);
  const auto saved = saved_probe(text);
  audit::AnyQuery query{static_cast<FeaturePair>(*kind), saved ? saved->dimension : 3, {}, {}};
  if (saved && !audit::fits(query, saved->probe)) {
    throw InputError(file.string(), "", "the line noli-fuzz asks for what a query of this kind has not");
  }
  std::vector<std::string> differences;
  const auto records = parse_query_csv(text, file.string(), *kind);
  for (const QueryRecord& record : records) {
    query.x_t0 = record.x_t0;
    query.x_t1 = record.x_t1;
    const auto found = audit::replay(query, saved ? std::optional(saved->probe) : std::nullopt);
    differences.insert(differences.end(), found.begin(), found.end());
  }
  const char* const word = differences.empty() ? "no_difference" : "finding";
  std::string lines = fmt::format("verdict {} queries {} findings {}\n", word, records.size(), differences.size());
  for (const std::string& difference : differences) lines += difference + '\n';
  output.write(lines, {{"verdict", word},
                       {"queries", records.size()},
                       {"findings", differences.size()},
                       {"probe", saved.has_value()},
                       {"differences", differences}});
  return differences.empty() ? ExitCode::holds : ExitCode::refuted;
}

ExitCode run(FuzzArguments& arguments, bool for_given) {
  if (arguments.replay) return replay(arguments);
  audit::FuzzOptions& options = arguments.options;
  if (for_given || !options.count) options.time_limit = parse_duration(arguments.duration, "--for");
  const Output output(arguments.json, {});
  require_writable_folder(arguments.out, "--out");
  options.out = arguments.out;
  options.stop = &interrupted();
  const Stopwatch watch;
  const audit::FuzzReport report = [&] {
    Progress bar("fuzz queries");
    options.progress = [&](const audit::FuzzProgress& progress) { bar.show(share(options, progress)); };
    return audit::fuzz_queries(options);
  }();
  const double seconds = watch.seconds();
  output.write(fuzz_text(options, report, seconds), fuzz_json(options, report, seconds));
  return exit_code(report);
}

}  // namespace

Command add_fuzz_queries(CLI::App& fuzz) {
  CLI::App* const command =
      fuzz.add_subcommand("queries", "Contact, distance, failure times of two features: kernel against oracle");
  command->footer(queries_footer);
  const auto arguments = std::make_shared<FuzzArguments>();
  audit::FuzzOptions& options = arguments->options;
  CLI::Option* const duration =
      command->add_option("--for", arguments->duration, "Stop after this time: 500ms, 60s, 5m, 1h")
          ->capture_default_str()
          ->type_name("TIME");
  command->add_option("--count", options.count, "Stop after so many queries")
      ->check(whole_number(1, std::uint64_t{1} << 60))
      ->type_name("N");
  command->add_option("--seed", options.seed, "What the queries depend on")
      ->capture_default_str()
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("S");
  add_threads_option(*command, options.threads);
  command->add_option("--out", arguments->out, "Folder for findings, made when there is one")
      ->capture_default_str()
      ->type_name("DIR");
  CLI::Option* const again =
      command->add_option("--replay", arguments->replay, "Decide the queries of this file again instead")
          ->type_name("FILE");
  for (CLI::Option* const other : command->get_options()) {
    if (other != again && other->get_name() != "--help" && other->get_name() != "--threads") again->excludes(other);
  }
  add_json_option(*command, arguments->json);
  return {command, [arguments, duration] { return run(*arguments, duration->count() > 0); }};
}

}  // namespace noli::app
