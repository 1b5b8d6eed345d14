// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/fuzz_queries_report.h"

#include <fmt/format.h>

#include <array>

#include <noli/errors.h>
#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/queries/saved_query.h"

namespace noli::audit {
namespace {

constexpr std::array<ContactKind, 4> kinds = {ContactKind::apart, ContactKind::touching, ContactKind::crossing,
                                              ContactKind::persistent};

Json answers_json(const std::array<std::uint64_t, 4>& answers) {
  Json json = Json::object();
  for (const ContactKind kind : kinds) json[std::string(name(kind))] = answers[static_cast<std::size_t>(kind)];
  return json;
}

Json corpus_json(const CorpusTally& corpus) {
  return {{"replayed", corpus.replayed}, {"signatures", corpus.signatures}, {"kept", corpus.kept}};
}

std::string corpus_text(const CorpusTally& corpus) {
  return fmt::format("Corpus: replayed {} signatures {} kept {}.\n", corpus.replayed, corpus.signatures, corpus.kept);
}

/// The command that asks a finding again; empty when it was not saved.
std::string command_for(const QueryFuzzSettings& options, const std::filesystem::path& file) {
  return file.empty() ? "" : options.command(file);
}

/// Where a finding lies, and the command that asks it again.
std::string whereabouts(const QueryFuzzSettings& options, const std::filesystem::path& file) {
  if (file.empty()) return "not saved";
  return "saved as " + on_one_line(file.string()) + "\n  again: " + on_one_line(options.command(file));
}

// --- the kernel against the oracle -----------------------------------------------------------------------------------

Json finding_json(const QueryFuzzSettings& options, const Finding& finding) {
  return {{"generator", finding.generator},
          {"block", finding.block},
          {"index", finding.index},
          {"difference", finding.difference},
          {"truth", name(finding.truth)},
          {"file", finding.place.string()},
          {"command", command_for(options, finding.place)}};
}

Json generator_json(const GeneratorTally& generator) {
  return {{"name", generator.name},
          {"pair", name(generator.type.pair)},
          {"dimension", generator.type.dimension},
          {"answers", answers_json(generator.answers)}};
}

Json probes_json(const ProbeTally& probes) {
  return {{"distance", {{"apart", probes.apart}, {"within", probes.within}}},
          {"failure_time",
           {{"failed", probes.failed}, {"failing", probes.failing}, {"never_failing", probes.never_failing}}}};
}

void append_generator(const GeneratorTally& generator, std::string& text) {
  text += fmt::format("  {} ({}, {}D):", generator.name, name(generator.type.pair), generator.type.dimension);
  for (const ContactKind kind : kinds) {
    text += fmt::format(" {} {}", name(kind), generator.answers[static_cast<std::size_t>(kind)]);
  }
  text += '\n';
}

// --- a library against the kernel ------------------------------------------------------------------------------------

constexpr std::array<LibraryFault, library_fault_count> faults = {
    LibraryFault::false_negative, LibraryFault::late,  LibraryFault::bad_time, LibraryFault::no_time,
    LibraryFault::failure,        LibraryFault::crash, LibraryFault::hang,     LibraryFault::memory,
    LibraryFault::false_positive, LibraryFault::early};

Json faults_json(const FaultCounts& counts) {
  Json json = Json::object();
  for (const LibraryFault fault : faults) {
    json[std::string(name(fault))] = counts[static_cast<std::size_t>(fault)];
  }
  return json;
}

Json point_json(const Point3& x) { return {x[0], x[1], x[2]}; }

Json query_json(const AnyQuery& query) {
  Json json = {{"pair", name(query.pair)}, {"x_t0", Json::array()}, {"x_t1", Json::array()}};
  for (std::size_t i = 0; i < query.size(); ++i) {
    json["x_t0"].push_back(point_json(query.x_t0[i]));
    json["x_t1"].push_back(point_json(query.x_t1[i]));
  }
  return json;
}

Json finding_json(const QueryFuzzSettings& options, const LibraryFinding& finding) {
  return {{"finding", name(finding.found.fault)},
          {"contact", name(finding.found.kind)},
          {"words", finding.found.words},
          {"generator", finding.generator},
          {"block", finding.block},
          {"index", finding.index},
          {"alike", finding.alike},
          {"query", query_json(finding.shrunk)},
          {"c_array", c_array(finding.shrunk)},
          {"distinct_coordinates", distinct_coordinates(finding.shrunk)},
          {"file", finding.file.string()},
          {"command", command_for(options, finding.file)}};
}

/// A line for each generator that had its turn.
std::string generators_text(const LibraryFuzzOptions& options, const LibraryFuzzReport& report) {
  std::string text;
  for (const LibraryTally& tally : report.generators) {
    if (tally.asked == 0) continue;
    std::uint64_t findings = 0;
    for (const LibraryFault fault : faults) {
      if (counts(fault, options.asked.exact)) findings += tally.faults[static_cast<std::size_t>(fault)];
    }
    text += fmt::format("  {}: asked {} contacts {} findings {} false_positives {} ({})\n", tally.name, tally.asked,
                        tally.contacts, findings, tally.faults[static_cast<std::size_t>(LibraryFault::false_positive)],
                        tally.attacks);
  }
  return text;
}

}  // namespace

Json fuzz_json(const QueryFuzzOptions& options, const QueryFuzzReport& report) {
  Json json = {{"verdict", report.verdict("no_difference")},
               {"seed", options.limits.seed},
               {"queries", report.items},
               {"findings", report.findings_total},
               {"answers", answers_json(report.answers)}};
  json["probes"] = probes_json(report.probes);
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) json["reports"].push_back(finding_json(options, finding));
  json["generators"] = Json::array();
  for (const auto& generator : report.generators) json["generators"].push_back(generator_json(generator));
  json["stages"] = stages_json(report.stages);
  if (options.corpus) json["corpus"] = corpus_json(report.corpus);
  return json;
}

std::string fuzz_text(const QueryFuzzOptions& options, const QueryFuzzReport& report) {
  std::string text;
  for (const auto& finding : report.findings) {
    text += fmt::format("finding: {}, block {}, query {}: {}; {}\n", finding.generator, finding.block, finding.index,
                        finding.difference, whereabouts(options, finding.place));
  }
  if (options.corpus) text += corpus_text(report.corpus);
  text += "Answers of the oracle:\n";
  for (const auto& generator : report.generators) append_generator(generator, text);
  const ProbeTally& probes = report.probes;
  text += fmt::format("Distances: apart {} within {}. Certificates: failed {} failing {} never_failing {}.\n",
                      probes.apart, probes.within, probes.failed, probes.failing, probes.never_failing);
  text += "Stages:";
  for (const Stage stage : all_stages) text += fmt::format(" {} {}", name(stage), report.stages[stage]);
  return text + '\n';
}

std::vector<std::string> fuzz_pairs(const QueryFuzzReport& /*report*/) { return {"queries", "findings", "seed"}; }

Json fuzz_json(const LibraryFuzzOptions& options, const LibraryFuzzReport& report) {
  Json json = {{"verdict", report.verdict()},
               {"library", options.asked.path.string()},
               {"tolerance", options.asked.tolerance},
               {"exact", options.asked.exact},
               {"late_tolerance", options.asked.late_tolerance},
               {"knows_times", report.knows_times},
               {"seed", options.limits.seed},
               {"queries", report.items},
               {"contacts", report.contacts},
               {"findings", report.findings_total},
               {"faults", faults_json(report.faults)}};
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) json["reports"].push_back(finding_json(options, finding));
  json["generators"] = Json::array();
  for (const auto& tally : report.generators) {
    json["generators"].push_back({{"name", tally.name},
                                  {"attacks", tally.attacks},
                                  {"asked", tally.asked},
                                  {"contacts", tally.contacts},
                                  {"faults", faults_json(tally.faults)}});
  }
  if (options.corpus) json["corpus"] = corpus_json(report.corpus);
  return json;
}

std::string fuzz_text(const LibraryFuzzOptions& options, const LibraryFuzzReport& report) {
  std::string text;
  for (const auto& finding : report.findings) {
    const std::size_t distinct = distinct_coordinates(finding.shrunk);
    text += fmt::format("{}\n  {}\n  {}, block {}, query {}; {} of this kind; shrunk to {} different number{}; {}\n",
                        finding.found.words, c_array(finding.shrunk), finding.generator, finding.block, finding.index,
                        finding.alike, distinct, distinct == 1 ? "" : "s", whereabouts(options, finding.file));
  }
  if (options.corpus) text += corpus_text(report.corpus);
  return text + "Generators (what each attacks):\n" + generators_text(options, report);
}

std::vector<std::string> fuzz_pairs(const LibraryFuzzReport& /*report*/) {
  std::vector<std::string> names = {"queries", "contacts", "findings"};
  for (const LibraryFault fault : faults) names.push_back(fmt::format("{0}=faults/{0}", name(fault)));
  names.emplace_back("seed");
  return names;
}

}  // namespace noli::audit
