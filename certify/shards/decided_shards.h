// SPDX-License-Identifier: Apache-2.0
//
// The steps that shards decided, read one shard at a time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certify/decided_steps.h"
#include "certify/shards/shard_file.h"
#include "certify/shards/shard_folder.h"
#include "certify/shards/step_json.h"
#include "certify/verification.h"
#include "proofs/prover/chain.h"

namespace noli {

class DecidedShards : public DecidedSteps {
 public:
  /// `request`: the one of the folder.
  DecidedShards(ShardFolder folder, const VerifyRequest& request)
      : folder_(std::move(folder)),
        of_run_(request.run),
        divided_(request.divide),
        max_reports_(reports_of_step(request)) {}

  StepResult result(std::uint64_t step, const Mesh& mesh, const RunWindow* window) override;
  void blocks(const std::function<void(FourLetters, std::string_view)>& take) override;
  StepResult with_positions(StepResult result, int dimension, std::span<const Position> x_t0,
                            std::span<const Position> x_t1) override;
  bool in_parts() const override { return divided_; }
  std::optional<ListedNear> near(const Mesh& mesh) override;
  std::optional<LargestDistance> largest_distance() override;
  std::filesystem::path scratch() const override { return folder_.path(); }
  void set_inputs(const std::vector<FrameFacts>& files) override;
  void set_claim(const Claim& claim) override;

 private:
  StepResult sum_of_parts(const Mesh& mesh);
  void open(std::uint64_t task);
  void require_inputs() const;
  void require_window(const RunWindow& window);
  std::string file() const { return folder_.shard(task_).string(); }
  std::uint64_t first() const { return task_ * steps_of_chain; }
  const char* step_word() const { return of_run_ ? "window" : "step"; }

  ShardFolder folder_;
  bool of_run_, divided_;
  std::size_t max_reports_;
  Json claim_;
  std::vector<FrameFacts> files_;
  std::optional<ShardReader> shard_;
  std::uint64_t task_ = 0, step_ = 0;
  std::string first_window_;         ///< its hash
  StepTimes times_;                  ///< of that step
  std::vector<FirstInStep> firsts_;  ///< of the parts that have one
  bool parts_are_proved_ = false;
};

}  // namespace noli
