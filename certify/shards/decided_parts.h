// SPDX-License-Identifier: Apache-2.0
//
// One step that shards decided in parts (--divide): joins what they found, and the tokens of their proofs.
#pragma once

#include <vector>

#include "certify/shards/decided_shards.h"
#include "certify/verification.h"

namespace noli {

class DecidedParts : public DecidedShards {
 public:
  /// `request`: the one of the folder.
  DecidedParts(ShardFolder folder, const VerifyRequest& request)
      : DecidedShards(std::move(folder), false), max_reports_(reports_of_step(request)) {}

  StepResult result(std::uint64_t step, const Mesh& mesh, const RunWindow* window) override;
  StepResult with_positions(StepResult result, int dimension, std::span<const Position> x_t0,
                            std::span<const Position> x_t1) override;
  bool in_parts() const override { return true; }
  void blocks(const std::function<void(FourLetters, std::string_view)>& take) override;

 private:
  std::string words_of(std::uint64_t task) const override;

  std::size_t max_reports_;
  std::vector<FirstInStep> firsts_;  ///< of the parts that have one
  bool all_proved_ = false;
};

}  // namespace noli
