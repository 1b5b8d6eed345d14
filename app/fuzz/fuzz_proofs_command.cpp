// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <utility>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/fuzz/fuzz_options.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/fuzz/proofs/fuzz_proofs.h"
#include "audit/fuzz/proofs/minimise_proof.h"
#include "audit/fuzz/shape_corpus.h"
#include "audit/fuzz/trajectories/motion_generators.h"
#include "certify/json.h"
#include "certify/process/scratch_folder.h"
#include "certify/process/this_program.h"
#include "certify/proofs/checker.h"
#include "certify/result_file.h"
#include "trajectory/text.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* proofs_footer =
    "Damages good proofs in many ways, with and without repairing checksums and hashes. Both checkers must give the "
    "same answer, and neither may accept a proof whose claim is false; an oracle that never looks at the proof decides "
    "that. Without PROOF, it first makes proofs of small motions.\n"
    "\n"
    "With --count the result depends only on the seed and the proofs. Exit codes: 0 no finding; 1 findings; 2 "
    "interrupted.\n"
    "Examples:\n"
    "  noli fuzz proofs --for 60s --seed 1\n"
    "  noli fuzz proofs proof.noli before.ply after.ply --count 100000\n"
    "  noli fuzz proofs runs/chain/proof.blocks runs/chain --verified-every 1\n"
    "  noli fuzz proofs --replay fuzz-findings/seed1-block3-index2\n"
    "  noli fuzz proofs --minimise fuzz-findings/seed1-block3-index2 --out smaller\n";

constexpr std::size_t most_candidates = 20'000;  // of --minimise

struct ProofsArguments {
  FuzzArgumentsInCommon common;
  std::vector<fs::path> files;
  ReplayArguments replay;
  std::uint64_t verified_every = 50;
};

/// Of a proof and its trajectory, which the checker has to take.
audit::ProofCase read_case(const fs::path& proof, const std::vector<fs::path>& trajectory) {
  const std::string bytes = read_whole_file(proof);
  const CheckerVerdict said =
      check_proof({.proof = proof, .trajectory = trajectory, .asked = audit::own_claim(bytes), .stop = &interrupted()});
  if (said.code == 3) {
    throw InputError(proof.string(), "", "expected a proof that holds: " + first_line(said.words));
  }
  audit::ProofCase made;
  made.name = proof.filename().string();
  made.proof = bytes;
  made.groups = parse_proof(made.proof, proof.string());
  made.extension = trajectory[0].extension().string().substr(1);
  for (const fs::path& file : trajectory) made.files.push_back(read_whole_file(file));
  made.refutes = said.code == 1;
  return made;
}

/// The proof or witness that `noli verify` writes of a motion with some claim; nothing if it writes none, as for some
/// degenerate contacts, or if the user would not wait.
std::optional<audit::ProofCase> made_case(const audit::FrameMotion& motion, const std::vector<std::string>& claim) {
  const ScratchFolder work_folder(ScratchFolder::Place::memory);
  const fs::path proof = work_folder.path() / "proof.noli";
  const std::vector<fs::path> files = audit::write_frames(motion, work_folder.path());
  std::vector<std::string> words = {
      this_program_file().string(), "verify", "--threads", "1", "--no-check", "--force", "--proof", proof};
  if (motion.at_rest()) words.emplace_back("--static");
  words.insert(words.end(), claim.begin(), claim.end());
  for (const fs::path& file : files) words.push_back(file);
  ProgramLimits limits;
  limits.stop = stop_by(&interrupted());
  const ProgramEnd end = run_program(words, limits);
  if (!end.exited_with(0) && !end.exited_with(1)) return std::nullopt;
  try {
    return read_case(proof, files);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Proofs and witnesses of small motions, with all sorts of claims.
std::vector<audit::ProofCase> made_cases() {
  const std::vector<std::vector<std::string>> claims = {{},
                                                        {"--strict"},
                                                        {"--points"},
                                                        {"--min-distance", "1e-9"},
                                                        {"--min-distance", "1e-6", "--min-distance-from-ring", "2"}};
  constexpr std::size_t motions = 60, most_cells = 12;
  const auto generators = audit::motion_generators();
  audit::Random random(1);
  std::vector<audit::ProofCase> cases;
  for (std::size_t i = 0; i < motions && !interrupted(); ++i) {
    const audit::MotionGenerator& generator = generators[i % generators.size()];
    const audit::FrameMotion motion = generator.make(random).motion;
    if (motion.mesh.cell_count() > most_cells) continue;
    auto made = made_case(motion, claims[i % claims.size()]);
    if (!made) continue;
    made->name = fmt::format("{} {}", generator.name, i);
    cases.push_back(std::move(*made));
  }
  return cases;
}

Json tally_json(const audit::CodeTally& tally) {
  return {
      {"accepted", tally.accepted}, {"refuted", tally.refuted}, {"rejected", tally.rejected}, {"failed", tally.failed}};
}

Json report_json(const ProofsArguments& arguments, const audit::ProofFuzzReport& report, std::size_t cases) {
  Json json = {{"verdict", report.verdict()},
               {"seed", arguments.common.limits.seed},
               {"mutants", report.items},
               {"findings", report.findings_total},
               {"proofs", cases},
               {"checked_verified", report.checked_verified},
               {"judged", report.judged},
               {"not_judged", report.not_judged},
               {"corpus", report.corpus_size},
               {"codes", tally_json(report.codes)}};
  json["mutations"] = Json::object();
  for (const auto& [name, tally] : report.mutations) json["mutations"][name] = tally_json(tally);
  json["reports"] = Json::array();
  for (const auto& finding : report.findings) {
    json["reports"].push_back({{"proof", finding.generator},
                               {"mutations", finding.mutations},
                               {"block", finding.block},
                               {"index", finding.index},
                               {"difference", finding.difference},
                               {"folder", finding.place.string()}});
  }
  return json;
}

std::string report_text(const ProofsArguments& arguments, const audit::ProofFuzzReport& report, std::size_t cases) {
  std::string text;
  for (const auto& finding : report.findings)
    text += finding_line(finding, "mutant", finding.mutations.empty() ? "" : finding.mutations + ": ");
  for (const auto& [name, tally] : report.mutations) {
    text += fmt::format("  {:26} accepted {:7} refuted {:7} rejected {:7} failed {:7}\n", name, tally.accepted,
                        tally.refuted, tally.rejected, tally.failed);
  }
  if (arguments.common.corpus) text += fmt::format("Corpus: {} proofs.\n", report.corpus_size);
  return text + fmt::format("Proofs: {}. The verified checker looked at {} mutants. Not judged: {}.\n", cases,
                            report.checked_verified, report.not_judged);
}

/// The proof that was given, or those that are made. Fewer if the user would not wait: then there are no mutants, and
/// that is told as undecided.
std::vector<audit::ProofCase> cases(const ProofsArguments& arguments) {
  try {
    if (arguments.files.empty()) return made_cases();
    return {
        read_case(arguments.files[0], trajectory_for_checker({arguments.files.begin() + 1, arguments.files.end()}))};
  } catch (const Stopped&) {
    return {};
  }
}

/// Of the checkers that lie beside this program.
audit::MakeCheckers checkers_beside() {
  const fs::path verified = beside_this_program("noli_check_verified");
  const bool has_verified = fs::exists(verified);
  if (!has_verified) std::fputs("noli: noli_check_verified was not found and is skipped\n", stderr);
  return [verified, has_verified] {
    ProgramLimits limits;
    limits.stop = stop_by(&interrupted());
    return audit::Checkers{audit::hosted_checker(beside_this_program("noli_check_host"), std::chrono::seconds(20)),
                           has_verified ? audit::program_checker(verified, limits) : nullptr};
  };
}

ExitCode run(ProofsArguments& arguments) {
  if (arguments.files.size() == 1) throw UsageError("expected a proof and its frames or run, or no files");
  const Output output = begin_fuzzing(arguments.common, arguments.files);
  audit::ProofFuzzOptions options;
  set_common(options, arguments.common);
  options.verified_every = arguments.verified_every;
  options.make_checkers = checkers_beside();
  options.cases = cases(arguments);
  if (options.cases.empty() && !interrupted()) throw std::runtime_error("no proof could be made to begin with");
  return run_fuzzer(
      {"fuzz proofs",
       "fuzz-proofs",
       {"mutants", "findings", "accepted=codes/accepted", "refuted=codes/refuted", "rejected=codes/rejected",
        "failed=codes/failed", "judged", "seed"}},
      output, options, audit::fuzz_proofs,
      [&](const auto& report) { return report_json(arguments, report, options.cases.size()); },
      [&](const auto& report) { return report_text(arguments, report, options.cases.size()); });
}

/// A saved proof again, as it is or made smaller.
ExitCode replay(const ProofsArguments& arguments) {
  if (!arguments.files.empty()) {
    throw UsageError("--replay and --minimise take a folder that was saved; expected no other files");
  }
  const Output output(arguments.common.results, saved_files(arguments.replay.saved()));
  if (arguments.replay.minimise) require_writable_folder(arguments.common.out, "--out");
  audit::JudgedProof proof{audit::read_proof_files(arguments.replay.saved()), {}};
  const audit::Checkers checkers = checkers_beside()();
  proof.judgement = audit::judge_proof(proof.files, checkers);
  const bool finding = !proof.judgement.difference.empty();
  std::optional<fs::path> saved;
  if (finding && arguments.replay.minimise) {
    proof = audit::minimise_finding(std::move(proof), checkers, interrupted(), most_candidates);
    saved = minimised_folder(arguments.common, arguments.replay.saved());
    const std::string what = "made smaller: " + on_one_line(arguments.replay.saved());
    audit::save_finding(proof.files, what, proof.judgement.difference, *saved);
  }
  const audit::ProofJudgement& judged = proof.judgement;
  const char* const claim = !judged.truth ? "not_judged" : *judged.truth ? "true" : "false";
  return tell_replay(output, {.unknown = judged.stopped || interrupted(),
                              .difference = finding ? std::optional(judged.difference) : std::nullopt,
                              .saved = saved,
                              .facts = {{"plain", word_of(judged.plain)},
                                        {"words", judged.plain.words},
                                        {"verified", judged.verified ? word_of(*judged.verified) : "not_asked"},
                                        {"claim", claim}},
                              .pairs = {"plain", "verified", "claim"},
                              .text = judged.plain.words.empty() ? "" : on_one_line(judged.plain.words) + '\n',
                              .about_saved = fmt::format(", a proof of {} bytes", proof.files.proof.size())});
}

}  // namespace

Command add_fuzz_proofs(CLI::App& fuzz) {
  CLI::App* const command = fuzz.add_subcommand("proofs", "Damaged proofs: both checkers must agree");
  command->footer(proofs_footer);
  const auto arguments = std::make_shared<ProofsArguments>();
  command->add_option("files", arguments->files, "A proof, then the PLY or OBJ files, or the run, that it is about")
      ->type_name("PROOF TRAJECTORY");
  add_fuzz_options(*command, arguments->common, "mutants");
  command
      ->add_option("--verified-every", arguments->verified_every,
                   "Ask the verified checker about one in N mutants, and about all accepted ones with a changed claim")
      ->check(whole_number(1, 1'000'000'000))
      ->capture_default_str()
      ->type_name("N");
  add_replay_options(*command, arguments->replay, "proof", "FOLDER", {});
  return {command, [arguments] { return arguments->replay.given() ? replay(*arguments) : run(*arguments); }};
}

}  // namespace noli::app
