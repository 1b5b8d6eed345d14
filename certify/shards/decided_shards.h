// SPDX-License-Identifier: Apache-2.0
//
// What shards decided, read one shard at a time: whole steps, or the parts of one step (--divide).
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

/// Whole steps, or windows.
class DecidedShards : public DecidedSteps {
 public:
  /// `of_run`: they are about windows.
  DecidedShards(ShardFolder folder, bool of_run) : folder_(std::move(folder)), of_run_(of_run) {}

  StepResult result(std::uint64_t step, const Mesh& mesh, const RunWindow* window) override;
  void blocks(const std::function<void(FourLetters, std::string_view)>& take) override;
  StepResult with_positions(StepResult result, int dimension, std::span<const Position> x_t0,
                            std::span<const Position> x_t1) override;
  std::optional<ListedNear> near(const Mesh& mesh) override;
  std::optional<LargestDistance> largest_distance() override;
  std::filesystem::path scratch() const override { return folder_.path(); }
  void set_inputs(const std::vector<FrameFacts>& files) override;
  void set_claim(const Claim& claim) override;

 protected:
  /// Makes the shard of a task the one that is read. Throws InputError when it is missing, damaged, or was made for
  /// other files or another claim.
  void open(std::uint64_t task);
  ShardReader& shard() { return *shard_; }
  std::string file() const { return folder_.shard(task_).string(); }
  /// Throws std::invalid_argument.
  static void require_meeting(const FeatureContact& contact, int dimension, std::span<const Position> x_t0,
                              std::span<const Position> x_t1);

 private:
  /// Which steps a task is about, for messages.
  virtual std::string words_of(std::uint64_t task) const;
  void require_inputs() const;
  void require_window(const RunWindow& window);
  std::uint64_t first() const { return task_ * steps_of_chain; }
  const char* step_word() const { return of_run_ ? "window" : "step"; }

  ShardFolder folder_;
  bool of_run_;
  Json claim_;
  std::vector<FrameFacts> files_;
  std::optional<ShardReader> shard_;
  std::uint64_t task_ = 0, step_ = 0;
  std::string first_window_;  ///< its hash
  StepTimes times_;           ///< of that step
};

/// One step that shards decided in parts: joins what they found, and the tokens of their proofs.
class DecidedParts : public DecidedShards {
 public:
  /// `request`: the one of the folder.
  DecidedParts(ShardFolder folder, const VerifyWork& request)
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
