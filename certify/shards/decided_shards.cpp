// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/decided_shards.h"

#include <fmt/format.h>

#include <noli/errors.h>
#include "certify/proofs/claim.h"
#include "certify/shards/step_json.h"
#include "trajectory/blocks/sha256.h"

namespace noli {

StepResult DecidedShards::result(std::uint64_t step) {
  if (!shard_ || step / steps_of_chain != task_) open(step / steps_of_chain);
  step_ = step;
  const std::string file = folder_.shard(task_).string();
  try {
    const Json& steps = shard_->head().at("steps");
    if (step - first() >= steps.size()) {
      throw InputError(file, "", fmt::format("ends before step {}; remove it, and do its task again", step + 1));
    }
    return step_of_json(steps.at(step - first()));
  } catch (const Json::exception& error) {
    throw InputError(file, "", error.what());
  } catch (const std::invalid_argument& error) {
    throw InputError(file, "", error.what());
  }
}

void DecidedShards::open(std::uint64_t task) {
  if (!folder_.has(task)) {
    throw InputError(folder_.path().string(), "",
                     fmt::format("the shard of task {} is missing (steps {} to {}); do it with `noli verify --shard`",
                                 task + 1, task * steps_of_chain + 1, (task + 1) * steps_of_chain));
  }
  shard_.emplace(folder_.shard(task), folder_.request_hash(), task);
  task_ = task;
  const Json& head = shard_->head();
  const std::string file = folder_.shard(task).string();
  if (head.value("claim", Json()) != claim_) {
    throw InputError(file, "", "was made for another claim: the frames are not those that it was made from");
  }
  for (const Json& known : head.value("files", Json::array())) {
    const auto index = known.at(0).get<std::uint64_t>();
    const auto hash = known.at(1).get<std::string>();
    if (hashes_.try_emplace(index, hash).first->second == hash) continue;
    throw InputError(file, "", fmt::format("was made from another frame {} than the shards before it", index));
  }
}

void DecidedShards::blocks(const std::function<void(FourLetters, std::string_view)>& take) {
  shard_->blocks(step_, take);
}

std::optional<ListedNear> DecidedShards::near() {
  const Json near = shard_->head().value("near", Json());
  if (near.is_null() || near.at("step") != step_) return std::nullopt;
  return near_of_json(near);
}

std::optional<LargestDistance> DecidedShards::largest_distance() {
  const Json largest = shard_->head().value("largest_distance", Json());
  if (largest.is_null()) return std::nullopt;
  return LargestDistance{largest.at("allowed").get<double>(), largest.at("limit").get<double>()};
}

void DecidedShards::require_claim(const Claim& claim) { claim_ = claim_json(claim); }

void DecidedShards::require_inputs(const std::vector<FrameFacts>& files) {
  for (const auto& [index, hash] : hashes_) {
    if (index < files.size() && files[index].looked_at && hex(files[index].sha256) == hash) continue;
    const std::string name = index < files.size() ? files[index].file : fmt::format("file {}", index);
    throw InputError(name, "", "is not the file that its shard was made from: its SHA-256 is another one");
  }
}

}  // namespace noli
