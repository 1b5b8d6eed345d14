// SPDX-License-Identifier: Apache-2.0
#include "app/fuzz/fuzz_library_motions_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "app/output.h"
#include "app/process.h"
#include "audit/fuzz/trajectories/fuzz_library_motions.h"
#include "certify/json.h"
#include "certify/process/run_program.h"
#include "certify/result_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// "noli fuzz trajectories --library ./mine.so --tolerance 1e-06 --replay", but for the folder.
Words replay_command(const LibraryArguments& library) {
  Words words = {"noli", "fuzz", "trajectories"};
  const Words more = library_words(library);
  words.insert(words.end(), more.begin(), more.end());
  words.emplace_back("--replay");
  return words;
}

std::string replay_command(const LibraryArguments& library, const fs::path& folder) {
  Words words = replay_command(library);
  words.push_back(folder.string());
  return on_one_line(shell_words(words));
}

void settle(LibraryMotionArguments& arguments) {
  settle_library(arguments.theirs);
  audit::HostOptions& host = arguments.theirs.asked.host;
  host.repeat_seconds = 0.01;  // for one step of a small mesh: thousands of calls
  host.search_limit = 1;       // the same
}

template <class Write>
void for_each_fault(const audit::MotionFaultCounts& counts, const Write& write) {
  for (std::size_t i = 0; i < counts.size(); ++i) write(name(static_cast<audit::MotionFault>(i)), counts[i]);
}

Json faults_json(const audit::MotionFaultCounts& counts) {
  Json json = Json::object();
  for_each_fault(counts, [&](std::string_view fault, std::uint64_t count) { json[std::string(fault)] = count; });
  return json;
}

Json library_finding_json(const LibraryMotionArguments& arguments, const audit::LibraryMotionFinding& finding) {
  const std::string folder = finding.folder.string();
  return {{"generator", finding.generator},
          {"block", finding.block},
          {"index", finding.index},
          {"finding", name(finding.found.fault)},
          {"contact", name(finding.found.kind)},
          {"step", finding.found.step + 1},
          {"through", finding.found.through},
          {"difference", finding.found.words},
          {"alike", finding.alike},
          {"frames", finding.shrunk.frames.size()},
          {"cells", finding.shrunk.mesh.cell_count()},
          {"vertices", finding.shrunk.mesh.vertex_count},
          {"folder", folder},
          {"command", folder.empty() ? "" : replay_command(arguments.theirs, folder)}};
}

Json report_json(const LibraryMotionArguments& arguments, const audit::LibraryMotionReport& report) {
  const audit::LibraryUnderTest& library = arguments.theirs.asked;
  Json json = {{"verdict", report.verdict()},
               {"library", library.path.string()},
               {"tolerance", library.tolerance},
               {"exact", library.exact},
               {"knows_times", report.knows_times},
               {"seed", arguments.common.limits.seed},
               {"trajectories", report.items},
               {"not_asked", report.not_asked},
               {"contacts", report.contacts},
               {"candidates", report.candidates},
               {"false_positives", report.false_positives},
               {"findings", report.findings_total},
               {"through", report.through},
               {"faults", faults_json(report.faults)},
               {"corpus", report.corpus_size}};
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) json["reports"].push_back(library_finding_json(arguments, finding));
  json["generators"] = Json::array();
  for (const auto& generator : report.generators) {
    json["generators"].push_back({{"name", generator.name},
                                  {"motions", generator.motions},
                                  {"contacts", generator.contacts},
                                  {"faults", faults_json(generator.faults)}});
  }
  return json;
}

std::string finding_text(const LibraryMotionArguments& arguments, const audit::LibraryMotionFinding& finding) {
  std::string text =
      fmt::format("{}\n  {}, block {}, motion {}; {} of this kind; {} frames, {} cells, {} vertices; ",
                  on_one_line(finding.found.words), finding.generator, finding.block, finding.index, finding.alike,
                  finding.shrunk.frames.size(), finding.shrunk.mesh.cell_count(), finding.shrunk.mesh.vertex_count);
  if (finding.folder.empty()) return text + "not saved\n";
  return text + fmt::format("saved as {}\n  again: {}\n", on_one_line(finding.folder.string()),
                            replay_command(arguments.theirs, finding.folder));
}

std::string report_text(const LibraryMotionArguments& arguments, const audit::LibraryMotionReport& report) {
  std::string text;
  for (const auto& finding : report.findings) text += finding_text(arguments, finding);
  for (const auto& generator : report.generators) {
    text += fmt::format("  {:12} motions {:6} contacts {:6}", generator.name, generator.motions, generator.contacts);
    for_each_fault(generator.faults, [&](std::string_view fault, std::uint64_t count) {
      if (count > 0) text += fmt::format(" {} {}", fault, count);
    });
    text += '\n';
  }
  if (arguments.common.corpus) text += fmt::format("Corpus: {} motions.\n", report.corpus_size);
  if (report.not_asked > 0) text += fmt::format("Skipped after too many hangs: {}.\n", report.not_asked);
  return text +
         fmt::format("Candidates: {}. False positives among them: {}.\n", report.candidates, report.false_positives);
}

std::vector<std::string> pairs() {
  std::vector<std::string> names = {"trajectories", "contacts", "findings", "through"};
  for_each_fault({},
                 [&](std::string_view fault, std::uint64_t) { names.push_back(fmt::format("{0}=faults/{0}", fault)); });
  names.emplace_back("seed");
  return names;
}

}  // namespace

Json motion_facts(const audit::FrameMotion& motion) {
  return {
      {"frames", motion.frames.size()}, {"cells", motion.mesh.cell_count()}, {"vertices", motion.mesh.vertex_count}};
}

ExitCode fuzz_motions_of_library(LibraryMotionArguments arguments) {
  settle(arguments);
  const Output output = begin_fuzzing(arguments.common, {arguments.theirs.asked.path});
  audit::LibraryMotionOptions options;
  set_common(options, arguments.common);
  options.asked = arguments.theirs.asked;
  options.families = arguments.families;
  options.first_only = arguments.theirs.first_only;
  options.max_findings = arguments.max_findings;
  options.replay_command = replay_command(arguments.theirs);
  return run_fuzzer(
      {"fuzz trajectories", "fuzz-library-trajectories", pairs()}, output, options, audit::fuzz_library_motions,
      [&](const auto& report) { return report_json(arguments, report); },
      [&](const auto& report) { return report_text(arguments, report); });
}

ExitCode replay_motion_of_library(LibraryMotionArguments arguments) {
  settle(arguments);
  const fs::path folder = arguments.replay.saved();
  const audit::LibraryUnderTest& library = arguments.theirs.asked;
  std::vector<fs::path> inputs = saved_files(folder);
  inputs.push_back(library.path);
  const Output output(arguments.common.results, inputs);
  if (arguments.replay.minimise) require_writable_folder(arguments.common.out, "--out");
  audit::FrameMotion motion = audit::read_frames(folder);
  audit::require_ccd_library(library.path, library.host);
  const bool knows_times = audit::knows_times(library);
  auto found = audit::ask_motion(library, motion, {}, {knows_times, true}).found;
  std::optional<fs::path> saved;
  if (found && arguments.replay.minimise) {
    audit::ShrunkMotion shrunk = audit::shrink_for_library(library, motion, *found, knows_times, 5000);
    motion = std::move(shrunk.motion);
    found = std::move(shrunk.found);
    saved = minimised_folder(arguments.common, folder);
    audit::save_motion(motion, found->words, replay_command(arguments.theirs), *saved);
  }
  Json facts = {{"library", library.path.string()}};
  facts.update(motion_facts(motion));
  return tell_replay(output, {.unknown = interrupted(),
                              .difference = found ? std::optional(found->words) : std::nullopt,
                              .saved = saved,
                              .facts = facts,
                              .pairs = {"frames", "cells", "vertices"},
                              .about_saved = saved ? "\n  again: " + replay_command(arguments.theirs, *saved) : ""});
}

}  // namespace noli::app
