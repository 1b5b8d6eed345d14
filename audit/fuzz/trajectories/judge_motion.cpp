// SPDX-License-Identifier: Apache-2.0
//
// Compares what the subject says of a motion with what the oracle does, and the oracle with what was planted.
#include <fmt/format.h>

#include <algorithm>

#include "audit/fuzz/trajectories/fuzz_trajectories.h"

namespace noli::audit {

namespace {

std::string contact_words(bool contact, std::size_t step) {
  return contact ? fmt::format("contact in step {}", step + 1) : "no contact";
}

/// The first contact that the subject names: the right time, and features that do what it says.
std::optional<std::string> first_difference(const FrameMotion& motion, const MotionTruth& truth,
                                            const MotionAnswer::First& first) {
  if (const double lower = truth.time->lower(); first.time != lower) {
    return fmt::format("first time: found {:.17g}, the oracle says {:.17g}", first.time, lower);
  }
  if (first.step != truth.step || !are_compared(motion.mesh, first.features)) {
    return fmt::format("features: {} of step {} are not among those to compare", words(first.features), first.step + 1);
  }
  const oracle::Answer answer = answer_of(motion, first.step, first.features);
  if (!answer.time || answer.time->compare(*truth.time) != 0) {
    return fmt::format("features: {} do not meet at the first time", words(first.features));
  }
  if (oracle::name(answer.kind) != first.kind) {
    return fmt::format("kind: found {}, the oracle says {}", first.kind, oracle::name(answer.kind));
  }
  return std::nullopt;
}

std::string_view word(CheckerWord said) {
  switch (said) {
    case CheckerWord::accepted: return "accepted";
    case CheckerWord::refuted: return "refuted";
    case CheckerWord::rejected: return "rejected";
    case CheckerWord::not_asked: return "not asked";
  }
  return "";
}

std::optional<std::string> checker_difference(const MotionAnswer& answer) {
  const CheckerWord expected = answer.contact ? CheckerWord::refuted : CheckerWord::accepted;
  for (const auto& [name, said] :
       {std::pair{"the plain checker", answer.plain}, {"the verified checker", answer.verified}}) {
    if (said != CheckerWord::not_asked && said != expected) {
      return fmt::format("checker: {} says {}, expected {}", name, word(said), word(expected));
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> difference(const FrameMotion& motion, const MotionTruth& truth, const MotionAnswer& answer) {
  if (!answer.failure.empty()) return "failure: " + answer.failure;
  if (answer.undecided) return std::nullopt;
  if (answer.contact != truth.contact || (truth.contact && answer.step != truth.step)) {
    return fmt::format("contact: found {}, the oracle says {}", contact_words(answer.contact, answer.step),
                       contact_words(truth.contact, truth.step));
  }
  if (answer.initial != truth.initial) {
    return fmt::format("first moment: found that cells {}, the oracle says otherwise",
                       answer.initial ? "meet" : "do not meet");
  }
  if (answer.first.has_value() != truth.time.has_value()) {
    return fmt::format("first contact: found {}, the oracle says otherwise",
                       answer.first ? "features that meet" : "none");
  }
  if (answer.first) {
    if (auto what = first_difference(motion, truth, *answer.first)) return what;
  }
  if (!answer.has_proof) {
    return fmt::format("proof: no {} was found", answer.contact ? "witness" : "proof");
  }
  return checker_difference(answer);
}

std::optional<std::string> difference(const FrameMotion& motion, const DecideMotion& decide,
                                      const std::atomic<bool>* stop) {
  if (std::string fault = text_fault(motion); !fault.empty()) return "files: " + fault;
  const MotionTruth truth = truth_of(motion, stop);
  if (truth.stopped) return std::nullopt;
  const MotionAnswer answer = decide(motion);
  if (answer.failure == "stopped") return std::nullopt;
  return difference(motion, truth, answer);
}

std::optional<std::string> broken_promise(const FrameMotion& motion, const PlantedTruth& planted,
                                          const MotionTruth& truth) {
  if (!planted.contact) return std::nullopt;
  if (*planted.contact != truth.contact || (truth.contact && planted.time && planted.step != truth.step)) {
    return fmt::format("planted: {}, the oracle says {}", contact_words(*planted.contact, planted.step),
                       contact_words(truth.contact, truth.step));
  }
  if (planted.initial && *planted.initial != truth.initial) return "planted: the oracle differs on the first moment";
  if (planted.time && (!truth.time || truth.time->compare(*planted.time) != 0)) {
    return fmt::format("planted: first time {:.17g}, the oracle says otherwise", *planted.time);
  }
  if (planted.features) {
    const oracle::Answer answer = answer_of(motion, truth.step, *planted.features);
    if (!answer.time || answer.time->compare(*truth.time) != 0) {
      return fmt::format("planted: {} meet first, the oracle says otherwise", words(*planted.features));
    }
  }
  return std::nullopt;
}

}  // namespace noli::audit
