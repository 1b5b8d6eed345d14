// SPDX-License-Identifier: Apache-2.0
//
// What was decided of the steps of a sequence, by other processes or machines, for a verification that joins it.
//
// Steps count from 0, and are asked for in ascending order.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <noli/sequence.h>
#include <noli/verify.h>
#include "certify/proofs/step_proofs.h"

namespace noli {

class DecidedSteps {
 public:
  DecidedSteps() = default;
  virtual ~DecidedSteps() = default;
  DecidedSteps(const DecidedSteps&) = delete;
  DecidedSteps& operator=(const DecidedSteps&) = delete;

  /// What was found in a step, without its proof. Throws InputError when nobody decided it, or what is there is
  /// damaged.
  virtual StepResult result(std::uint64_t step) = 0;
  /// The blocks of the proof or witness of the step that result() gave last; none if none was found. Throws as
  /// result().
  virtual void blocks(const std::function<void(FourLetters, std::string_view)>& take) = 0;
  /// What comes too near in that step; `step` is not set.
  virtual std::optional<ListedNear> near() = 0;
  /// The largest least distance at the beginning of that step, where it was looked for.
  virtual std::optional<LargestDistance> largest_distance() = 0;

  /// Throws InputError unless this is the claim that was asked when steps were decided.
  virtual void require_claim(const Claim& claim) = 0;
  /// Throws InputError unless the files that were read are those that were decided.
  virtual void require_inputs(const std::vector<FrameFacts>& files) = 0;
};

}  // namespace noli
