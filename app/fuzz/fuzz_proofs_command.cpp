// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <utility>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/fuzz/fuzz_options.h"
#include "app/options.h"
#include "app/output.h"
#include "app/process.h"
#include "audit/fuzz/proofs/fuzz_proofs_report.h"
#include "audit/fuzz/proofs/minimise_proof.h"
#include "audit/fuzz/proofs/proof_cases.h"
#include "certify/result_file.h"

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

struct ProofsArguments {
  FuzzArgumentsInCommon common;
  std::vector<fs::path> files;
  ReplayArguments replay;
  std::uint64_t verified_every = 50;
};

audit::MakeCheckers make_checkers() {
  note_missing_verified_checker();
  return audit::checkers_beside_this_program(interrupted());
}

ExitCode run(ProofsArguments& arguments) {
  if (arguments.files.size() == 1) throw UsageError("expected a proof and its frames or run, or no files");
  const Output output = begin_fuzzing(arguments.common, arguments.files);
  audit::ProofFuzzOptions options;
  set_common(options, arguments.common);
  options.verified_every = arguments.verified_every;
  options.make_checkers = make_checkers();
  options.cases = audit::proof_cases(arguments.files, interrupted());
  if (options.cases.empty() && !interrupted()) throw std::runtime_error("no proof could be made to begin with");
  return run_fuzzer("fuzz proofs", "fuzz-proofs", output, options, audit::fuzz_proofs);
}

/// A saved proof again, as it is or made smaller.
ExitCode replay(const ProofsArguments& arguments) {
  if (!arguments.files.empty()) {
    throw UsageError("--replay and --minimise take a folder that was saved; expected no other files");
  }
  const bool smaller = arguments.replay.minimise.has_value();
  const Output output(arguments.common.results, saved_files(arguments.replay.saved()));
  if (smaller) require_writable_folder(arguments.common.out, "--out");
  audit::ProofFiles files = audit::read_proof_files(arguments.replay.saved());
  const audit::Checkers checkers = make_checkers()();
  const audit::JudgedProof proof = audit::replay_proof(std::move(files), smaller, checkers, interrupted());
  const bool finding = !proof.judgement.difference.empty();
  std::optional<fs::path> saved;
  if (finding && smaller) {
    saved = minimised_folder(arguments.common, arguments.replay.saved());
    const std::string what = "made smaller: " + on_one_line(arguments.replay.saved());
    audit::save_finding(proof.files, what, proof.judgement.difference, *saved);
  }
  const audit::ProofJudgement& judged = proof.judgement;
  return tell_replay(output, {.unknown = judged.stopped || interrupted(),
                              .difference = finding ? std::optional(judged.difference) : std::nullopt,
                              .saved = saved,
                              .facts = audit::proof_facts(judged),
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
