// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/fuzz_proofs.h"

#include <algorithm>
#include <set>
#include <utility>

#include "audit/fuzz/save_finding.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

struct JudgedMutant {
  ProofMutant mutant;
  std::size_t from = 0;  ///< the number of its case
  ProofJudgement judgement;
};

class ProofFuzzing : public Fuzzing<ProofFuzzing, ProofFuzzOptions, ProofFuzzReport, JudgedMutant> {
 public:
  static constexpr std::uint64_t items_per_block = 512;
  using Fuzzing::Fuzzing;

  std::vector<JudgedMutant> make_block(std::uint64_t block, std::uint64_t count) const {
    Random random(options_.limits.seed, block);
    const Checkers checkers = options_.make_checkers();
    std::vector<JudgedMutant> all;
    std::set<std::string> shapes;
    for (std::uint64_t index = 0; index < count && !stopped(); ++index) {
      JudgedMutant judged;
      judged.from = random.below(options_.cases.size());
      judged.mutant = make_mutant(options_.cases[judged.from], options_.cases, random);
      const bool ask_verified = (block * items_per_block + index) % options_.verified_every == 0;
      judged.judgement = judge_mutant(options_.cases[judged.from], judged.mutant, checkers, ask_verified);
      const bool finding = !judged.judgement.difference.empty();
      const bool may_be_kept = corpus_ && !finding && shapes.insert(shape_of(judged.judgement)).second;
      if (!finding && !may_be_kept) judged.mutant = {judged.mutant.mutations, {}, {}};
      all.push_back(std::move(judged));
    }
    return all;
  }

  bool take_saved(const std::string& name) {
    const ProofFiles files = read_proof_files(corpus_->folder(name));
    const ProofJudgement judged = judge_proof(files, checkers());
    corpus_->reached(shape_of(judged));
    if (!judged.difference.empty() && is_kept())
      keep(ProofFinding{{"corpus/" + name, 0, 0, judged.difference, {}}, "", files},
           [&](ProofFinding& kept) { save(kept, unused(options_.out / name)); });
    return true;
  }

  void take(const JudgedMutant& judged, std::size_t index) {
    const ProofJudgement& judgement = judged.judgement;
    const std::string& mutations = judged.mutant.mutations;
    count(judgement.plain, report_.codes);
    for (std::size_t at = 0; at <= mutations.size();) {
      const std::size_t end = std::min(mutations.find('+', at), mutations.size());
      count(judgement.plain, report_.mutations[mutations.substr(at, end - at)]);
      at = end + 1;
    }
    const bool said = judgement.plain.failure.empty() && judgement.plain.code != 3;
    report_.checked_verified += judgement.verified ? 1 : 0;
    report_.judged += judgement.judged ? 1 : 0;
    report_.not_judged += said && !judgement.truth && judgement.difference.empty() ? 1 : 0;
    if (!judgement.difference.empty()) return shrink(judged, index);
    add_if_new(shape_of(judgement), [&](const fs::path& folder) {
      write_proof_files(files_of(options_.cases[judged.from], judged.mutant), folder);
    });
  }

  std::uint64_t items() const { return report_.codes.all(); }

 private:
  static void count(const ProofAnswer& answer, CodeTally& tally) {
    const bool failed = !answer.failure.empty();
    ++(failed ? tally.failed : answer.code == 0 ? tally.accepted : answer.code == 1 ? tally.refuted : tally.rejected);
  }

  void shrink(const JudgedMutant& judged, std::size_t index) {
    if (!is_kept()) return;
    const ProofCase& from = options_.cases[judged.from];
    const std::string& difference = judged.judgement.difference;
    const ProofMutant simpler = minimise(from, judged.mutant, [&](const ProofMutant& candidate) {
      return judge_mutant(from, candidate, checkers(), true).difference == difference;
    });
    keep(ProofFinding{{from.name, block_, index, difference, {}}, judged.mutant.mutations, files_of(from, simpler)},
         [&](ProofFinding& kept) { save(kept, folder_for(kept.block, kept.index, "")); });
  }

  /// For what is judged one after another.
  const Checkers& checkers() {
    if (!checkers_) checkers_ = options_.make_checkers();
    return *checkers_;
  }

  static void save(ProofFinding& finding, const fs::path& folder) {
    finding.place = folder;
    save_finding(finding.files, finding.generator + ": " + finding.mutations, finding.difference, folder);
  }

  std::optional<Checkers> checkers_;
};

}  // namespace

void save_finding(const ProofFiles& files, const std::string& what, const std::string& difference,
                  const fs::path& folder) {
  save_whole(folder, what + '\n' + difference, {"noli", "fuzz", "proofs", "--replay", folder},
             [&](const fs::path& to) { write_proof_files(files, to); });
}

ProofFuzzReport fuzz_proofs(const ProofFuzzOptions& options) { return ProofFuzzing(options).run(); }

}  // namespace noli::audit
