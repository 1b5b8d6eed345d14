// SPDX-License-Identifier: Apache-2.0
//
// What was decided of the steps of a sequence or a run, by other processes or machines, for a verification that joins
// it.
//
// Steps count from 0, and are asked for in ascending order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <noli/sequence.h>
#include <noli/verify.h>
#include "certify/proofs/step_proofs.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

class DecidedSteps {
 public:
  DecidedSteps() = default;
  virtual ~DecidedSteps() = default;
  DecidedSteps(const DecidedSteps&) = delete;
  DecidedSteps& operator=(const DecidedSteps&) = delete;

  /// What was found in a step of the mesh, without its proof. `window`: of a run, the window as it is now; of frames,
  /// nullptr. Throws InputError when the step is missing, damaged, or was decided for other files or another window.
  virtual StepResult result(std::uint64_t step, const Mesh& mesh, const RunWindow* window) = 0;
  /// The blocks of the proof or witness of the step that result() gave last; none if none was found. Throws as
  /// result().
  virtual void blocks(const std::function<void(FourLetters, std::string_view)>& take) = 0;
  /// What comes too near in that step; `step` is not set.
  virtual std::optional<ListedNear> near(const Mesh& mesh) = 0;
  /// The largest least distance at the beginning of that step, where it was looked for.
  virtual std::optional<LargestDistance> largest_distance() = 0;

  /// Of frames: `result`, as result() gave it last, now that the positions are known. Of a step that was decided in
  /// parts, only this has the first contact. Throws InputError when a contact does not meet.
  virtual StepResult with_positions(StepResult result, int dimension, std::span<const Position> x_t0,
                                    std::span<const Position> x_t1) = 0;
  /// Whether the step was decided in parts. blocks() then passes on the tree and the tokens of all parts, without STEP,
  /// and no witness; nothing if a part has no proof.
  virtual bool in_parts() const { return false; }

  /// A folder with room for about as much as the proof takes.
  virtual std::filesystem::path scratch() const = 0;

  /// Of frames: the files, once they were looked at. Steps that were decided for others are refused.
  virtual void set_inputs(const std::vector<FrameFacts>& files) = 0;
  /// The claim, as far as it is known before the first step. Steps that were decided for another are refused.
  virtual void set_claim(const Claim& claim) = 0;
};

}  // namespace noli
