// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/proof_judge.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include <noli/errors.h>
#include "audit/fuzz/proofs/claim_oracle.h"
#include "audit/fuzz/shape_corpus.h"
#include "certify/process/this_program.h"
#include "certify/proofs/checker.h"
#include "certify/proofs/parsed_claim.h"
#include "trajectory/formats/frames.h"

namespace noli::audit {

namespace {

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

/// Whether the claim of a proof holds of its trajectory; nothing where that is not judged. `whole`: else only frames
/// before the first that cannot be read count, as for a witness, behind whose step no checker looks. Throws InputError
/// for what cannot be read.
std::optional<bool> claim_is_true(const ProofCase& from, const ProofMutant& mutant, bool whole) {
  if (from.extension == "blocks") return std::nullopt;
  const auto claim = parse_claim(parse_proof(mutant.proof, "mutant"));
  if (claim && claim->source == 2) return std::nullopt;
  const bool possible = claim && claim->source < 2 && (claim->dimension == 2 || claim->dimension == 3) &&
                        std::isfinite(claim->eta) && claim->eta >= 0;
  if (!possible) throw InputError("mutant", "", "makes no claim that could be true");
  const FrameMotion motion = read_trajectory(from.extension, mutant.files ? *mutant.files : from.files, whole);
  const auto claimed = claimed_mesh(*claim, motion.mesh);
  if (!claimed) throw InputError("mutant", "", "merges a vertex that does not exist");
  if (motion.frames.size() < (claim->source == 1 ? 1 : 2)) throw InputError("mutant", "", "is about no step");
  return claim_holds(*claim, *claimed, motion.frames);
}

class ProofJudge {
 public:
  ProofJudge(const ProofCase& from, const ProofMutant& mutant, const Checkers& checkers)
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
    const char* const said = word_of(judgement_.plain);
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
    found(fmt::format("the plain checker: {}, the verified one: {}", word_of(judgement_.plain), word_of(verified)));
  }

  const ProofCase& from_;
  const ProofMutant& mutant_;
  const Checkers& checkers_;
  ProofFiles files_;
  ProofJudgement judgement_;
};

}  // namespace

MakeCheckers checkers_beside_this_program(const std::atomic<bool>& stop) {
  return [&stop, has_verified = has_checker(Checker::verified)] {
    ProgramLimits limits;
    limits.stop = stop_by(&stop);
    return Checkers{hosted_checker(beside_this_program("noli_check_host"), std::chrono::seconds(20)),
                    has_verified ? program_checker(beside_this_program("noli_check_verified"), limits) : nullptr};
  };
}

ProofFiles files_of(const ProofCase& from, const ProofMutant& mutant) {
  return {mutant.proof, from.extension, mutant.files.value_or(from.files)};
}

const char* word_of(const ProofAnswer& answer) {
  if (!answer.failure.empty()) return "failed";
  return answer.code == 0 ? "accepted" : answer.code == 1 ? "refuted" : "rejected";
}

ProofJudgement judge_mutant(const ProofCase& from, const ProofMutant& mutant, const Checkers& checkers,
                            bool ask_verified) {
  return ProofJudge(from, mutant, checkers).judge(ask_verified);
}

ProofJudgement judge_proof(const ProofFiles& files, const Checkers& checkers) {
  ProofCase nothing;  // all of the mutant was changed
  nothing.extension = files.extension;
  return judge_mutant(nothing, {"", files.proof, files.files}, checkers, true);
}

std::string kind_of(const ProofJudgement& judgement) {
  if (judgement.difference.empty()) return "";
  const bool rejected = judgement.plain.failure.empty() && judgement.plain.code == 3;
  const std::string why = rejected ? "; " + without_numbers(judgement.plain.words) : "";
  return without_numbers(judgement.difference) + why;
}

std::string shape_of(const ProofJudgement& judgement) {
  if (judgement.plain.code == 3) return without_numbers(judgement.plain.words);
  const char* const claim = judgement.judged  ? "a changed claim"
                            : judgement.truth ? "the claim as it was"
                                              : "a claim that was not judged";
  return fmt::format("{}: {}", word_of(judgement.plain), claim);
}

}  // namespace noli::audit
