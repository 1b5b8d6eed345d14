// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/fuzz_trajectories_report.h"

#include <fmt/format.h>

#include <noli/errors.h>
#include "audit/fuzz/finding_report.h"
#include "certify/process/run_program.h"

namespace noli::audit {
namespace {

std::uint64_t undecided_motions(const TrajectoryReport& report) {
  std::uint64_t count = 0;
  for (const TrajectoryTally& generator : report.generators) count += generator.undecided;
  return count;
}

template <class Write>
void for_each_fault(const MotionFaultCounts& counts, const Write& write) {
  for (std::size_t i = 0; i < counts.size(); ++i) write(name(static_cast<MotionFault>(i)), counts[i]);
}

Json faults_json(const MotionFaultCounts& counts) {
  Json json = Json::object();
  for_each_fault(counts, [&](std::string_view fault, std::uint64_t count) { json[std::string(fault)] = count; });
  return json;
}

Json finding_json(const LibraryMotionOptions& options, const LibraryMotionFinding& finding) {
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
          {"command", folder.empty() ? "" : replay_line(options.replay_command, folder)}};
}

std::string finding_text(const LibraryMotionOptions& options, const LibraryMotionFinding& finding) {
  std::string text =
      fmt::format("{}\n  {}, block {}, motion {}; {} of this kind; {} frames, {} cells, {} vertices; ",
                  on_one_line(finding.found.words), finding.generator, finding.block, finding.index, finding.alike,
                  finding.shrunk.frames.size(), finding.shrunk.mesh.cell_count(), finding.shrunk.mesh.vertex_count);
  if (finding.folder.empty()) return text + "not saved\n";
  return text + fmt::format("saved as {}\n  again: {}\n", on_one_line(finding.folder.string()),
                            replay_line(options.replay_command, finding.folder));
}

}  // namespace

Json fuzz_json(const TrajectoryOptions& options, const TrajectoryReport& report) {
  Json json = {{"verdict", report.verdict()},
               {"seed", options.limits.seed},
               {"trajectories", report.items},
               {"findings", report.findings_total},
               {"undecided", undecided_motions(report)},
               {"checked", {{"plain", report.checked_plain}, {"verified", report.checked_verified}}},
               {"shapes", report.shapes},
               {"corpus", report.corpus_size}};
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) json["reports"].push_back(finding_json(finding, "folder"));
  json["generators"] = Json::array();
  for (const auto& generator : report.generators) {
    json["generators"].push_back({{"name", generator.name},
                                  {"apart", generator.apart},
                                  {"contact", generator.contact},
                                  {"without_witness", generator.without_witness},
                                  {"undecided", generator.undecided}});
  }
  return json;
}

std::string fuzz_text(const TrajectoryOptions& options, const TrajectoryReport& report) {
  std::string text;
  for (const auto& finding : report.findings) text += finding_line(finding, "motion");
  for (const auto& generator : report.generators) {
    text += fmt::format("  {:12} apart {:6} contact {:6} without_witness {}\n", generator.name, generator.apart,
                        generator.contact, generator.without_witness);
  }
  if (options.corpus) text += fmt::format("Corpus: {} motions.\n", report.corpus_size);
  return text + fmt::format("The verified checker looked at {} proofs. Not decided in time: {}. Shapes: {}.\n",
                            report.checked_verified, undecided_motions(report), report.shapes);
}

std::vector<std::string> fuzz_pairs(const TrajectoryReport& /*report*/) {
  return {"trajectories", "findings", "checked=checked/plain", "seed"};
}

Json fuzz_json(const LibraryMotionOptions& options, const LibraryMotionReport& report) {
  Json json = {{"verdict", report.verdict()},
               {"library", options.asked.path.string()},
               {"tolerance", options.asked.tolerance},
               {"exact", options.asked.exact},
               {"knows_times", report.knows_times},
               {"seed", options.limits.seed},
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
  for (const auto& finding : report.findings) json["reports"].push_back(finding_json(options, finding));
  json["generators"] = Json::array();
  for (const auto& generator : report.generators) {
    json["generators"].push_back({{"name", generator.name},
                                  {"motions", generator.motions},
                                  {"contacts", generator.contacts},
                                  {"faults", faults_json(generator.faults)}});
  }
  return json;
}

std::string fuzz_text(const LibraryMotionOptions& options, const LibraryMotionReport& report) {
  std::string text;
  for (const auto& finding : report.findings) text += finding_text(options, finding);
  for (const auto& generator : report.generators) {
    text += fmt::format("  {:12} motions {:6} contacts {:6}", generator.name, generator.motions, generator.contacts);
    for_each_fault(generator.faults, [&](std::string_view fault, std::uint64_t count) {
      if (count > 0) text += fmt::format(" {} {}", fault, count);
    });
    text += '\n';
  }
  if (options.corpus) text += fmt::format("Corpus: {} motions.\n", report.corpus_size);
  if (report.not_asked > 0) text += fmt::format("Skipped after too many hangs: {}.\n", report.not_asked);
  return text +
         fmt::format("Candidates: {}. False positives among them: {}.\n", report.candidates, report.false_positives);
}

std::vector<std::string> fuzz_pairs(const LibraryMotionReport& /*report*/) {
  std::vector<std::string> names = {"trajectories", "contacts", "findings", "through"};
  for_each_fault({},
                 [&](std::string_view fault, std::uint64_t) { names.push_back(fmt::format("{0}=faults/{0}", fault)); });
  names.emplace_back("seed");
  return names;
}

Json motion_facts(const FrameMotion& motion) {
  return {
      {"frames", motion.frames.size()}, {"cells", motion.mesh.cell_count()}, {"vertices", motion.mesh.vertex_count}};
}

std::string replay_line(std::vector<std::string> command, const std::filesystem::path& folder) {
  command.push_back(folder.string());
  return on_one_line(shell_words(command));
}

}  // namespace noli::audit
