// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/fuzz_proofs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <set>
#include <utility>

#include "noli/audit/claim_oracle.h"
#include "noli/audit/parsed_claim.h"
#include "noli/audit/shape_corpus.h"
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
  ProofJudgement judgement;
  std::string shape;
};

/// Asks the checkers, and the oracle where they accept what was changed.
class ProofJudge {
 public:
  ProofJudge(const ProofCase& from, const ProofMutant& mutant, Checkers& checkers)
      : from_(from), mutant_(mutant), checkers_(checkers), files_(files_of(from, mutant)) {}

  ProofJudgement judge(bool ask_verified) {
    judgement_.plain = checkers_.plain->check(files_);
    if (!judgement_.plain.failure.empty()) {
      found("the plain checker: " + judgement_.plain.failure);
      return std::move(judgement_);
    }
    if (judgement_.plain.code != 3) look_at_truth();
    const bool accepted_anew = accepted() && (judgement_.judged || !judgement_.truth);
    if (checkers_.verified && (ask_verified || accepted_anew)) compare();
    return std::move(judgement_);
  }

 private:
  bool accepted() const { return judgement_.plain.code == 0; }
  void found(const std::string& what) { judgement_.difference = what; }

  void look_at_truth() {
    const char* const said = word(judgement_.plain.code);
    try {
      find_truth();
    } catch (const InputError& error) {
      return found(fmt::format("the plain checker: {}, but Noli cannot read it: {}", said, error.what()));
    }
    if (judgement_.truth && *judgement_.truth != accepted())
      found(fmt::format("the plain checker: {}, but the claim is {}", said, *judgement_.truth ? "true" : "false"));
  }

  /// Where neither claim nor trajectory was changed, what was true of the case is.
  void find_truth() {
    const bool unchanged =
        !mutant_.files && parse_claim(parse_proof(mutant_.proof, "mutant")) == parse_claim(from_.groups);
    judgement_.truth = unchanged ? !from_.refutes : claim_is_true(from_, mutant_, accepted());
    judgement_.judged = !unchanged && judgement_.truth.has_value();
  }

  void compare() {
    judgement_.verified = checkers_.verified->check(files_);
    const ProofAnswer& verified = *judgement_.verified;
    judgement_.stopped = verified.failure == "stopped";
    if (judgement_.stopped) return;
    if (!verified.failure.empty()) return found("the verified checker: " + verified.failure);
    if (verified.code == judgement_.plain.code) return;
    found(fmt::format("the plain checker: {}, the verified one: {}", word(judgement_.plain.code), word(verified.code)));
  }

  const ProofCase& from_;
  const ProofMutant& mutant_;
  Checkers& checkers_;
  ProofFiles files_;
  ProofJudgement judgement_;
};

/// What a mutant reached: where the checker rejects it, or that it takes what was changed.
std::string shape_of(const ProofJudgement& judgement) {
  if (judgement.plain.code == 3) return without_numbers(judgement.plain.words);
  return fmt::format("{}: {}", word(judgement.plain.code),
                     judgement.judged ? "a changed claim" : "the claim as it was");
}

/// A saved proof as a mutant of nothing: its claim is judged.
JudgedMutant judge_saved(const ProofFiles& files, Checkers& checkers) {
  ProofCase from;
  from.name = "saved";
  from.extension = files.extension;
  from.files = files.files;
  JudgedMutant judged;
  judged.mutant = {"", files.proof, files.files};
  judged.judgement = ProofJudge(from, judged.mutant, checkers).judge(true);
  judged.shape = shape_of(judged.judgement);
  return judged;
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
  explicit ProofFuzzing(const ProofFuzzOptions& options) : options_(options) {
    if (options.corpus) corpus_.emplace(*options.corpus);
  }

  ProofFuzzReport run() {
    if (corpus_) run_corpus();
    report_.extent = fuzz_blocks(
        options_.limits, mutants_per_block,
        [this](std::uint64_t block, std::uint64_t count) { return make_block(block, count); },
        [this](std::vector<JudgedMutant> block) { take_block(std::move(block)); });
    report_.extent.items = report_.codes.accepted + report_.codes.refuted + report_.codes.rejected;
    report_.corpus_size = corpus_ ? corpus_->names().size() : 0;
    return std::move(report_);
  }

 private:
  bool stopped() const { return options_.limits.stop && options_.limits.stop->load(); }

  std::vector<JudgedMutant> make_block(std::uint64_t block, std::uint64_t count) const {
    Random random(options_.limits.seed, block);
    Checkers checkers = make_checkers(options_);
    std::vector<JudgedMutant> all;
    std::set<std::string> shapes;
    for (std::uint64_t index = 0; index < count && !stopped(); ++index) {
      JudgedMutant judged;
      judged.from = random.below(options_.cases.size());
      judged.mutant = make_mutant(options_.cases[judged.from], options_.cases, random);
      const bool ask_verified = (block * mutants_per_block + index) % options_.verified_every == 0;
      judged.judgement = ProofJudge(options_.cases[judged.from], judged.mutant, checkers).judge(ask_verified);
      judged.shape = shape_of(judged.judgement);
      const bool wanted = corpus_ && shapes.insert(judged.shape).second;
      if (judged.judgement.difference.empty() && !wanted) judged.mutant = {judged.mutant.mutations, {}, {}};
      all.push_back(std::move(judged));
    }
    return all;
  }

  void run_corpus() {
    Checkers checkers = make_checkers(options_);
    for (const std::string& name : corpus_->names()) {
      if (stopped()) return;
      const ProofFiles files = read_proof_files(corpus_->folder(name));
      const JudgedMutant judged = judge_saved(files, checkers);
      corpus_->reached(judged.shape);
      if (judged.judgement.difference.empty()) continue;
      ++report_.findings_total;
      keep({"corpus/" + name, "", 0, 0, judged.judgement.difference, files, {}}, name);
    }
  }

  static void count(int code, CodeTally& tally) {
    ++(code == 0 ? tally.accepted : code == 1 ? tally.refuted : tally.rejected);
  }

  void take_block(std::vector<JudgedMutant> block) {
    for (std::size_t index = 0; index < block.size(); ++index) take(block[index], index);
    ++block_;
  }

  void take(const JudgedMutant& judged, std::size_t index) {
    const ProofJudgement& judgement = judged.judgement;
    const std::string& mutations = judged.mutant.mutations;
    count(judgement.plain.code, report_.codes);
    for (std::size_t at = 0; at <= mutations.size();) {
      const std::size_t end = std::min(mutations.find('+', at), mutations.size());
      count(judgement.plain.code, report_.mutations[mutations.substr(at, end - at)]);
      at = end + 1;
    }
    const bool said = judgement.plain.failure.empty() && judgement.plain.code != 3;
    report_.checked_verified += judgement.verified ? 1 : 0;
    report_.judged += judgement.judged ? 1 : 0;
    report_.not_judged += said && !judgement.truth && judgement.difference.empty() ? 1 : 0;
    if (!judgement.difference.empty()) return shrink(judged, index);
    if (!corpus_ || !corpus_->reached(judged.shape)) return;
    corpus_->add(judged.shape, [&](const fs::path& folder) {
      write_proof_files(files_of(options_.cases[judged.from], judged.mutant), folder);
    });
  }

  void shrink(const JudgedMutant& judged, std::size_t index) {
    ++report_.findings_total;
    if (report_.findings.size() >= options_.max_findings) return;
    const ProofCase& from = options_.cases[judged.from];
    Checkers checkers = make_checkers(options_);
    const std::string& difference = judged.judgement.difference;
    const ProofMutant simpler = MutantMinimiser(from, judged.mutant, [&](const ProofMutant& candidate) {
                                  return ProofJudge(from, candidate, checkers).judge(true).difference == difference;
                                }).run();
    keep({from.name, judged.mutant.mutations, block_, index, difference, files_of(from, simpler), {}},
         fmt::format("seed{}-block{}-index{}", options_.limits.seed, block_, index));
  }

  void keep(ProofFinding finding, const std::string& name) {
    if (report_.findings.size() >= options_.max_findings) return;
    if (!options_.out.empty()) save(finding, name);
    report_.findings.push_back(std::move(finding));
  }

  void save(ProofFinding& finding, const std::string& name) const {
    finding.folder = options_.out / name;
    fs::create_directories(finding.folder);
    write_proof_files(finding.files, finding.folder);
    write_file(finding.folder / "README",
               fmt::format("{}: {}\n{}\nShown again by\n  {}\n", finding.name, finding.mutations, finding.difference,
                           shell_words({"noli", "fuzz", "proofs", "--replay", finding.folder})));
  }

  const ProofFuzzOptions& options_;
  std::optional<ShapeCorpus> corpus_;
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

ProofJudgement judge_proof(const ProofFiles& files, const ProofFuzzOptions& options) {
  Checkers checkers = make_checkers(options);
  return judge_saved(files, checkers).judgement;
}

ProofFuzzReport fuzz_proofs(const ProofFuzzOptions& options) { return ProofFuzzing(options).run(); }

}  // namespace noli::audit
