// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/library_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "audit/fuzz/trajectories/motion_oracle.h"
#include "certify/verification.h"

namespace noli::audit {

namespace {

std::string words(const FeatureContact& pair) {
  const auto& v = pair.vertices;
  if (pair.pair == FeaturePair::edge_edge) return fmt::format("edges {}-{} and {}-{}", v[0], v[1], v[2], v[3]);
  return fmt::format("vertex {} and face {}-{}-{}", v[0], v[1], v[2], v[3]);
}

std::optional<MotionFault> fault_of_end(Ending::Kind end) {
  switch (end) {
    case Ending::Kind::crashed: return MotionFault::crash;
    case Ending::Kind::hung: return MotionFault::hang;
    case Ending::Kind::too_much_memory: return MotionFault::memory;
    case Ending::Kind::finished:
    case Ending::Kind::stopped: break;
  }
  return std::nullopt;
}

MotionFault fault_named(std::string_view word) {
  for (std::size_t i = 0; i < motion_fault_count; ++i) {
    const auto fault = static_cast<MotionFault>(i);
    if (name(fault) == word) return fault;
  }
  throw std::logic_error("a finding without a fault");
}

/// The pair of a finding is told to the world, so the oracle looks at it too.
void require_that_the_oracle_agrees(const FrameMotion& motion, std::size_t step, const PipelineFinding& finding) {
  const auto& v = finding.contact.vertices;
  const std::size_t first = finding.contact.pair == FeaturePair::edge_edge ? 2 : 1;
  FeatureTwo features;
  for (std::size_t i = 0; i < 4; ++i) features[i < first ? 0 : 1].push_back(v[i]);
  const auto time = first_within(3, motion.begin(step), motion.end(step), features, 0);
  if (time.has_value() == finding.exact.has_value() && (!time || time->lower() == *finding.exact)) return;
  throw std::logic_error("kernel and oracle disagree on a pair that a library got wrong: " + words(finding.contact));
}

void require_what_was_planted(const FrameMotion& motion, const PlantedTruth& planted, std::size_t step,
                              const PipelineOutcome& outcome) {
  if (!planted.contact || motion.dimension() != 3) return;
  const auto require = [&](bool holds) {
    if (!holds) throw std::logic_error(fmt::format("the truth about step {} contradicts what was planted", step + 1));
  };
  if (!*planted.contact || step < planted.step) return require(!outcome.first_time);
  const auto is_asked = [](const FeatureTwo& features) { return features[0].size() + features[1].size() == 4; };
  if (step == planted.step && planted.features && is_asked(*planted.features)) {
    require(outcome.first_time == planted.time);
  }
}

class StepJudge {
 public:
  StepJudge(const FrameMotion& motion, std::size_t step, const PipelineAudit& audit)
      : motion_(motion), step_(step), audit_(audit) {}

  std::optional<MotionFaultFound> operator()() const {
    if (const auto ended = fault_of_end(audit_.ending.kind)) {
      const std::string place = audit_.in_search ? ", in the search for candidates"
                                : audit_.asked   ? where(audit_.asked)
                                                 : ", at an unknown place";
      return found(*ended, audit_.ending.words + place);
    }
    if (!audit_.searched) return found(MotionFault::failure, "the search for candidates failed");
    if (auto of_a_pair = worst_report()) return of_a_pair;
    if (audit_.failures > 0) return found(MotionFault::failure, "the query failed" + where(audit_.failed));
    if (audit_.bad_pairs > 0) {
      return found(MotionFault::bad_pair,
                   fmt::format("{} candidates are not two features without a common vertex", audit_.bad_pairs));
    }
    if (audit_.leaks) return found(MotionFault::leak, "memory grows whenever the step is asked again");
    return std::nullopt;
  }

 private:
  MotionFaultFound found(MotionFault fault, const std::string& what) const {
    const char* const through = audit_.through ? "; a simulation that trusts it goes through the contact" : "";
    return {fault, ContactKind::apart, step_, audit_.through,
            fmt::format("{}: step {}: {}{}", name(fault), step_ + 1, what, through)};
  }

  static std::string where(const std::optional<FeatureContact>& asked) {
    return asked ? ", asked about " + words(*asked) : "";
  }

  std::optional<MotionFaultFound> worst_report() const {
    const auto rank = [](const PipelineFinding& finding) { return fault_named(finding.what); };
    const auto worst = std::ranges::min_element(audit_.reports, {}, rank);
    if (worst == audit_.reports.end()) return std::nullopt;
    require_that_the_oracle_agrees(motion_, step_, *worst);
    const FeatureContact& pair = worst->contact;
    const auto exact = exact_contact(query_of(pair, 3, motion_.begin(step_), motion_.end(step_)));
    const std::string kind = exact ? fmt::format(" ({})", name(exact->kind)) : "";
    MotionFaultFound result = found(rank(*worst), words(pair) + ": " + worst->words + kind);
    if (exact) result.kind = exact->kind;
    return result;
  }

  const FrameMotion& motion_;
  std::size_t step_;
  const PipelineAudit& audit_;
};

PipelineRequest request_of(const LibraryUnderTest& library, const MotionQuestion& question) {
  PipelineRequest request;
  request.libraries = {library.path};
  request.tolerances = {library.tolerance};
  request.max_reports = std::numeric_limits<std::size_t>::max();
  request.host = library.host;
  request.needs_search = false;
  request.exact = library.exact;
  request.knows_times = question.knows_times;
  request.looks_for_leaks = question.leaks;
  return request;
}

/// None, one or several.
char how_many(std::uint64_t count) { return count == 0 ? '0' : count == 1 ? '1' : '+'; }

std::string shape_of(const PipelineOutcome& step, const PipelineAudit& audit) {
  const char at = !step.first_time ? '-' : *step.first_time == 0 ? 'b' : *step.first_time == 1 ? 'e' : 'i';
  return fmt::format(" {}{}{} candidates {}{} false {}{} early {}", how_many(step.contacts[0]),
                     how_many(step.contacts[1]), at, how_many(audit.candidates[0]), how_many(audit.candidates[1]),
                     how_many(audit.false_positives[0]), how_many(audit.false_positives[1]),
                     audit.early.worst() > 0 ? '+' : '0');
}

}  // namespace

LibraryMotionAnswer ask_motion(const LibraryUnderTest& library, const FrameMotion& motion, const PlantedTruth& planted,
                               const MotionQuestion& question) {
  const PipelineRequest request = request_of(library, question);
  LibraryMotionAnswer answer;
  for (std::size_t step = 0; step < motion.steps() && !answer.found; ++step) {
    const PipelineOutcome outcome = audit_pipeline(request, motion.mesh, motion.begin(step), motion.end(step));
    answer.stopped = outcome.audits.empty() || outcome.audits[0].ending.kind == Ending::Kind::stopped;
    if (answer.stopped) return answer;
    const PipelineAudit& audit = outcome.audits[0];
    require_what_was_planted(motion, planted, step, outcome);
    answer.contacts += outcome.contacts[0] + outcome.contacts[1];
    answer.candidates += audit.candidates[0] + audit.candidates[1];
    answer.false_positives += audit.false_positives[0] + audit.false_positives[1];
    answer.found = StepJudge(motion, step, audit)();
    answer.shape += shape_of(outcome, audit);
  }
  if (answer.found) answer.shape += fmt::format(" {}", name(answer.found->fault));
  return answer;
}

}  // namespace noli::audit
