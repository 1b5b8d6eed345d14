// SPDX-License-Identifier: Apache-2.0
//
// One step between two frames, decided in parts (StepPart, proofs/prover/verifier.h), perhaps by several processes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <noli/sequence.h>
#include <noli/verify.h>
#include "proofs/prover/verifier.h"

namespace noli {

/// The parts that one process decides: next() says which, take() gets what was found.
class StepParts {
 public:
  StepParts() = default;
  virtual ~StepParts() = default;
  StepParts(const StepParts&) = delete;
  StepParts& operator=(const StepParts&) = delete;

  /// Whether parts in which nothing touches are to be proved.
  virtual bool are_proved() const = 0;
  /// The next part to decide; nothing when there are no more. Throws Stopped.
  virtual std::optional<StepPart> next() = 0;
  /// `result`: with the proof, if there is one. `outcome`: the claim and the files.
  virtual void take(const StepPart& part, const StepResult& result, const VerifyOutcome& outcome) = 0;
};

/// Adds up the parts: everything except `first`, which needs the positions (earliest_of). Lists at most `most` contacts
/// and as many initial intersections.
StepResult sum_of(std::vector<StepResult> parts, std::size_t most);

/// The earliest of the parts' first contacts. Precondition: each of them meets.
std::optional<FirstInStep> earliest_of(const std::vector<FirstInStep>& parts, int dimension,
                                       std::span<const Position> x_t0, std::span<const Position> x_t1);

}  // namespace noli
