// SPDX-License-Identifier: Apache-2.0
//
// The steps that shards decided, read one shard at a time.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "certify/decided_steps.h"
#include "certify/shards/shard_file.h"
#include "certify/shards/shard_folder.h"
#include "proofs/prover/chain.h"

namespace noli {

class DecidedShards : public DecidedSteps {
 public:
  explicit DecidedShards(ShardFolder folder) : folder_(std::move(folder)) {}

  StepResult result(std::uint64_t step, const Mesh& mesh, const std::optional<Sha256Digest>& window) override;
  void blocks(const std::function<void(FourLetters, std::string_view)>& take) override;
  std::optional<ListedNear> near(const Mesh& mesh) override;
  std::optional<LargestDistance> largest_distance() override;
  std::filesystem::path scratch() const override { return folder_.path(); }
  void set_inputs(const std::vector<FrameFacts>& files) override;
  void set_claim(const Claim& claim) override;

 private:
  void open(std::uint64_t task);
  void require_inputs() const;
  void require_window(const Sha256Digest& window) const;
  std::string file() const { return folder_.shard(task_).string(); }
  std::uint64_t first() const { return task_ * steps_of_chain; }
  /// Times are in [0, 1] of a step between frames, and in seconds of a run.
  double last_time() const { return is_run_ ? std::numeric_limits<double>::max() : 1; }

  ShardFolder folder_;
  Json claim_;
  std::vector<FrameFacts> files_;
  std::optional<ShardReader> shard_;
  std::uint64_t task_ = 0, step_ = 0;
  bool is_run_ = false;
};

}  // namespace noli
