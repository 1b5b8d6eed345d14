// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/fuzz_proofs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "noli/audit/claim_oracle.h"
#include "noli/audit/parsed_claim.h"
#include "noli/trajectory/error.h"
#include "noli/trajectory/frames.h"
#include "noli/trajectory/write_file.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t mutants_per_block = 512;

const char* word(int code) { return code == 0 ? "accepted" : code == 1 ? "refuted" : "rejected"; }

ProofFiles files_of(const ProofCase& from, const ProofMutant& mutant) {
  return {mutant.proof, from.extension, mutant.files.value_or(from.files)};
}

/// The checkers of one thread.
struct Checkers {
  std::unique_ptr<ProofChecker> plain, verified;
};

Checkers make_checkers(const ProofFuzzOptions& options) {
  return {options.plain(), options.verified ? options.verified() : nullptr};
}

struct JudgedMutant {
  ProofMutant mutant;
  std::size_t from = 0;  ///< the number of its case
  int code = 3;
  bool verified = false, judged = false, not_judged = false;
  std::string difference;
};

/// Asks the checkers, and the oracle where they accept what was changed.
void judge(const ProofCase& from, Checkers& checkers, bool ask_verified, JudgedMutant& judged) {
  const ProofFiles files = files_of(from, judged.mutant);
  const ProofAnswer plain = checkers.plain->check(files);
  judged.code = plain.code;
  if (!plain.failure.empty()) {
    judged.difference = "the plain checker: " + plain.failure;
    return;
  }
  std::optional<bool> truth;
  if (plain.code != 3) {
    try {
      const bool unchanged =
          !judged.mutant.files && parse_claim(parse_proof(judged.mutant.proof, "mutant")) == parse_claim(from.groups);
      truth = unchanged ? !from.refutes : claim_is_true(from, judged.mutant, plain.code == 0);
      judged.judged = !unchanged && truth.has_value();
      judged.not_judged = !truth.has_value();
    } catch (const InputError& error) {
      judged.difference =
          fmt::format("the plain checker: {}, but Noli cannot read it: {}", word(plain.code), error.what());
      return;
    }
  }
  if (truth && *truth != (plain.code == 0)) {
    judged.difference =
        fmt::format("the plain checker: {}, but the claim is {}", word(plain.code), *truth ? "true" : "false");
  }
  const bool accepted_anew = plain.code == 0 && (judged.judged || judged.not_judged);
  if (!checkers.verified || !(ask_verified || accepted_anew)) return;
  judged.verified = true;
  const ProofAnswer verified = checkers.verified->check(files);
  if (verified.failure == "stopped") return;
  if (!verified.failure.empty()) {
    judged.difference = "the verified checker: " + verified.failure;
  } else if (verified.code != plain.code) {
    judged.difference =
        fmt::format("the plain checker: {}, the verified one: {}", word(plain.code), word(verified.code));
  }
}

/// Puts back what the finding does not need to be changed.
class MutantMinimiser {
 public:
  MutantMinimiser(const ProofCase& from, ProofMutant mutant, std::function<bool(const ProofMutant&)> fails)
      : from_(from), mutant_(std::move(mutant)), fails_(std::move(fails)) {}

  ProofMutant run() {
    put_back_files();
    try {
      ProofGroups groups = parse_proof(mutant_.proof, "mutant");
      put_back_blocks(groups);
    } catch (const InputError&) {  // its bytes are no blocks
      put_back_bytes(mutant_.proof, from_.proof,
                     [](ProofMutant& candidate, const std::string& bytes) { candidate.proof = bytes; });
    }
    return mutant_;
  }

 private:
  bool accept(const ProofMutant& candidate) {
    if (!fails_(candidate)) return false;
    mutant_ = candidate;
    return true;
  }

  void put_back_files() {
    if (!mutant_.files) return;
    ProofMutant candidate = mutant_;
    candidate.files.reset();
    accept(candidate);
  }

  void put_back_blocks(ProofGroups& groups) {
    for (std::size_t g = 0; g < std::min(groups.size(), from_.groups.size()); ++g) {
      for (std::size_t b = 0; b < std::min(groups[g].size(), from_.groups[g].size()); ++b) {
        if (groups[g][b] == from_.groups[g][b]) continue;
        ProofGroups candidate = groups;
        candidate[g][b] = from_.groups[g][b];
        if (with(candidate)) {
          groups = candidate;
          continue;
        }
        put_back_bytes(groups[g][b].payload, from_.groups[g][b].payload,
                       [&](ProofMutant& changed, const std::string& payload) {
                         candidate = groups;
                         candidate[g][b].payload = payload;
                         changed.proof = proof_bytes(candidate);
                       });
      }
    }
  }

  bool with(const ProofGroups& groups) {
    ProofMutant candidate = mutant_;
    candidate.proof = proof_bytes(groups);
    return accept(candidate);
  }

  /// Byte by byte, where the lengths are equal.
  template <class Change>
  void put_back_bytes(std::string bytes, const std::string& original, const Change& change) {
    for (std::size_t i = 0; bytes.size() == original.size() && i < bytes.size() && i < 4096; ++i) {
      if (bytes[i] == original[i]) continue;
      std::string candidate_bytes = bytes;
      candidate_bytes[i] = original[i];
      ProofMutant candidate = mutant_;
      change(candidate, candidate_bytes);
      if (accept(candidate)) bytes = candidate_bytes;
    }
  }

  const ProofCase& from_;
  ProofMutant mutant_;
  std::function<bool(const ProofMutant&)> fails_;
};

/// The frames; if not the whole trajectory counts, up to the first that cannot be read.
FrameMotion read_trajectory(const std::string& extension, const std::vector<std::string>& files, bool whole) {
  FrameMotion motion;
  for (std::size_t i = 0; i < files.size(); ++i) {
    try {
      const std::string name = fmt::format("frame-{}.{}", i, extension);
      Frame frame = parse_frame(files[i], name);
      if (i == 0) motion.mesh = frame.mesh;
      require_same_mesh(motion.mesh, "frame-0", frame.mesh, name);
      motion.frames.push_back(std::move(frame.positions));
    } catch (const InputError&) {
      if (whole) throw;
      break;
    }
  }
  return motion;
}

class ProofFuzzing {
 public:
  explicit ProofFuzzing(const ProofFuzzOptions& options) : options_(options) {}

  ProofFuzzReport run() {
    report_.extent = fuzz_blocks(
        options_.limits, mutants_per_block,
        [this](std::uint64_t block, std::uint64_t count) { return make_block(block, count); },
        [this](std::vector<JudgedMutant> block) { take_block(std::move(block)); });
    report_.extent.items = report_.codes.accepted + report_.codes.refuted + report_.codes.rejected;
    return std::move(report_);
  }

 private:
  std::vector<JudgedMutant> make_block(std::uint64_t block, std::uint64_t count) const {
    Random random(options_.limits.seed, block);
    Checkers checkers = make_checkers(options_);
    std::vector<JudgedMutant> all;
    for (std::uint64_t index = 0; index < count; ++index) {
      if (options_.limits.stop && options_.limits.stop->load()) break;
      JudgedMutant judged;
      judged.from = random.below(options_.cases.size());
      judged.mutant = make_mutant(options_.cases[judged.from], options_.cases, random);
      judge(options_.cases[judged.from], checkers, (block * mutants_per_block + index) % options_.verified_every == 0,
            judged);
      if (judged.difference.empty()) judged.mutant = {judged.mutant.mutations, {}, {}};
      all.push_back(std::move(judged));
    }
    return all;
  }

  static void count(int code, CodeTally& tally) {
    ++(code == 0 ? tally.accepted : code == 1 ? tally.refuted : tally.rejected);
  }

  void take_block(std::vector<JudgedMutant> block) {
    for (std::size_t index = 0; index < block.size(); ++index) {
      JudgedMutant& judged = block[index];
      count(judged.code, report_.codes);
      for (std::size_t at = 0; at <= judged.mutant.mutations.size();) {
        const std::size_t end = std::min(judged.mutant.mutations.find('+', at), judged.mutant.mutations.size());
        count(judged.code, report_.mutations[judged.mutant.mutations.substr(at, end - at)]);
        at = end + 1;
      }
      report_.checked_verified += judged.verified ? 1 : 0;
      report_.judged += judged.judged ? 1 : 0;
      report_.not_judged += judged.not_judged ? 1 : 0;
      if (!judged.difference.empty()) keep(std::move(judged), index);
    }
    ++block_;
  }

  void keep(JudgedMutant judged, std::size_t index) {
    ++report_.findings_total;
    if (report_.findings.size() >= options_.max_findings) return;
    const ProofCase& from = options_.cases[judged.from];
    Checkers checkers = make_checkers(options_);
    const ProofMutant simpler = MutantMinimiser(from, judged.mutant, [&](const ProofMutant& candidate) {
                                  JudgedMutant again;
                                  again.mutant = candidate;
                                  judge(from, checkers, true, again);
                                  return again.difference == judged.difference;
                                }).run();
    ProofFinding finding{from.name,         judged.mutant.mutations, block_, index,
                         judged.difference, files_of(from, simpler), {}};
    if (!options_.out.empty()) save(finding);
    report_.findings.push_back(std::move(finding));
  }

  void save(ProofFinding& finding) const {
    finding.folder =
        options_.out / fmt::format("seed{}-block{}-index{}", options_.limits.seed, finding.block, finding.index);
    fs::create_directories(finding.folder);
    std::vector<std::string> command = {"noli", "check"};
    for (const std::string& name : write_proof_files(finding.files, finding.folder))
      command.push_back(finding.folder / name);
    const std::string line = shell_words(command);
    write_file(finding.folder / "README", fmt::format("{}: {}\n{}\nShown again by\n  {}\n  {} --verified\n",
                                                      finding.name, finding.mutations, finding.difference, line, line));
  }

  const ProofFuzzOptions& options_;
  std::uint64_t block_ = 0;
  ProofFuzzReport report_;
};

}  // namespace

std::optional<bool> claim_is_true(const ProofCase& from, const ProofMutant& mutant, bool whole) {
  if (from.extension == "blocks") return std::nullopt;
  const auto claim = parse_claim(parse_proof(mutant.proof, "mutant"));
  if (claim && claim->source == 2) return std::nullopt;
  const bool possible = claim && claim->source < 2 && (claim->dimension == 2 || claim->dimension == 3) &&
                        std::isfinite(claim->eta) && claim->eta >= 0;
  if (!possible) throw InputError("mutant", "", "makes no claim that could be true");
  const FrameMotion motion = read_trajectory(from.extension, mutant.files ? *mutant.files : from.files, whole);
  const auto claimed = claimed_mesh(*claim, motion.mesh);
  if (!claimed) throw InputError("mutant", "", "merges a vertex that is not there");
  if (motion.frames.size() < (claim->source == 1 ? 1 : 2)) throw InputError("mutant", "", "is about no step");
  return claim_holds(*claim, *claimed, motion.frames);
}

ProofFuzzReport fuzz_proofs(const ProofFuzzOptions& options) { return ProofFuzzing(options).run(); }

}  // namespace noli::audit
