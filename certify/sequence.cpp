// SPDX-License-Identifier: Apache-2.0
#include <noli/sequence.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "certify/verification.h"
#include "proofs/prover/cells/baseline.h"
#include "proofs/prover/chain.h"
#include "proofs/prover/verifier.h"
#include "proofs/prover/windows/window_verifier.h"

namespace noli {

SequenceVerifier::SequenceVerifier(Mesh mesh, SequenceOptions options)
    : mesh_(std::move(mesh)), options_(std::move(options)), steps_(options_.first_step) {}
SequenceVerifier::~SequenceVerifier() = default;
SequenceVerifier::SequenceVerifier(SequenceVerifier&&) noexcept = default;
SequenceVerifier& SequenceVerifier::operator=(SequenceVerifier&&) noexcept = default;

const std::vector<InitialIntersection>& SequenceVerifier::baseline(std::span<const Position> x) {
  if (!options_.only_new) throw std::logic_error("baseline(): expected only_new");
  if (baseline_) return baseline_->pairs();
  VerifyOptions options = step_options();
  options.initial = true;
  options.first_only = false;
  options.max_reports = most_of_baseline;
  VerifyResult found = verify_between(x, x, options);
  if (found.initial_intersections > most_of_baseline) {
    throw std::length_error(fmt::format("more than {} pairs of cells intersect in the first frame", most_of_baseline));
  }
  baseline_ = std::make_unique<const Baseline>(mesh_, std::move(found.initial_reports));
  return baseline_->pairs();
}

std::optional<StepResult> SequenceVerifier::add(std::span<const Position> x) {
  if (options_.at_rest) return step(x, x);
  if (last_) return step(*last_, x);
  last_.emplace(x.begin(), x.end());
  return std::nullopt;
}

VerifyOptions SequenceVerifier::step_options() const {
  VerifyOptions options;
  options.dimension = options_.dimension;
  options.threads = options_.threads;
  options.initial = options_.at_rest || steps_ == 0;
  options.first_only = options_.first_only;
  options.strict = options_.strict;
  options.max_reports = options_.max_reports;
  options.baseline = baseline_.get();
  options.stop = options_.stop;
  options.deadline = options_.deadline;
  return options;
}

StepResult SequenceVerifier::step(std::span<const Position> x_t0, std::span<const Position> x_t1, bool prove) {
  return decide(x_t0, x_t1, prove, nullptr);
}

StepResult SequenceVerifier::step_for(std::span<const Position> x_t0, std::span<const Position> x_t1,
                                      ProofReceiver& receiver) {
  if (options_.only_new || options_.exclusions != nullptr) {
    throw std::logic_error("step_for(): expected no only_new and no exclusions");
  }
  return decide(x_t0, x_t1, true, &receiver);
}

StepResult SequenceVerifier::decide(std::span<const Position> x_t0, std::span<const Position> x_t1, bool prove,
                                    ProofReceiver* receiver) {
  if (options_.only_new) baseline(x_t0);
  take_back(x_t0);
  const std::uint64_t steps_before = steps_;
  const bool meeting_before = meeting_at_end_;
  if (starts_chain(steps_)) {
    windows_.reset();
    chain_.reset();
  }
  VerifyOptions options = step_options();
  // What was found before the first step that is given is not known here.
  options.after_step = !options_.at_rest && (steps_ == options_.first_step ? steps_ > 0 : meeting_at_end_);
  options.prove = prove && !baseline_;
  options.receiver = receiver;
  options.chain = &chain_;
  options.progress = options_.progress;
  VerifyResult found = verify_between(x_t0, x_t1, options);
  ++steps_;
  meeting_at_end_ = found.contact_count() + found.going_on > 0;
  StepResult result = result_of(std::move(found), x_t0, x_t1);
  if (result.touches() && !result.rests) {
    rejected_ = Rejected{{x_t0.begin(), x_t0.end()}, steps_before, meeting_before};
  }
  if (last_) last_->assign(x_t1.begin(), x_t1.end());
  return result;
}

StepResult SequenceVerifier::part_of_step(std::span<const Position> x_t0, std::span<const Position> x_t1,
                                          const StepPart& part, bool prove) {
  if (steps_ != options_.first_step || options_.first_only || options_.only_new || options_.exclusions != nullptr) {
    throw std::logic_error("part_of_step(): expected no step before, and no first_only, only_new or exclusions");
  }
  VerifyOptions options = step_options();
  options.prove = prove;
  options.part = part;
  options.chain = &chain_;
  options.progress = options_.progress;
  return result_of(verify_between(x_t0, x_t1, options), x_t0, x_t1);
}

StepResult SequenceVerifier::result_of(VerifyResult found, std::span<const Position> x_t0,
                                       std::span<const Position> x_t1) const {
  StepResult result{std::move(static_cast<Findings&>(found)), {}, std::move(found.proof), found.receiver_has_proof};
  result.rests = std::ranges::equal(x_t0, x_t1);
  if (found.first) result.first = first_in_step(*found.first, query_of(*found.first, options_.dimension, x_t0, x_t1));
  return result;
}

/// If the step that comes is another attempt at the last one, what that one met counts as never seen.
void SequenceVerifier::take_back(std::span<const Position> x_t0) {
  const auto rejected = std::exchange(rejected_, std::nullopt);
  if (!rejected || !std::ranges::equal(x_t0, rejected->x_t0)) return;
  steps_ = rejected->steps;
  meeting_at_end_ = rejected->meeting_at_end;
}

/// Only the verifier of windows supports exclusions.
VerifyResult SequenceVerifier::verify_between(std::span<const Position> x_t0, std::span<const Position> x_t1,
                                              const VerifyOptions& options) {
  if (options_.exclusions == nullptr) return verify_step(mesh_, x_t0, x_t1, options);
  const WindowOptions window{options, {}, options_.exclusions};
  if (!windows_) windows_ = std::make_unique<const WindowVerifier>(mesh_, x_t0, window);
  WindowResult found = windows_->verify(WorldLines::from_frames(x_t0, x_t1), window);
  std::optional<FeatureContact> first;
  if (found.first) first = found.first->contact;
  return {std::move(static_cast<Findings&>(found)), first, nullptr};
}

}  // namespace noli
