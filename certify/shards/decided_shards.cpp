// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/decided_shards.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include <noli/contact.h>
#include <noli/errors.h>
#include "certify/shards/shards.h"
#include "certify/step_parts.h"
#include "proofs/prover/tokens/proof_file.h"

namespace noli {
namespace {

constexpr const char* remedy = "run `noli verify --shard` again: it does the rest";

}  // namespace

StepResult DecidedShards::result(std::uint64_t step, const Mesh& mesh, const RunWindow* window) {
  if (!shard_ || step / steps_of_chain != task_ || step <= step_) open(step / steps_of_chain);
  step_ = step;
  return reading(file(), [&] {
    const Json& steps = shard_->head().at("steps");
    if (step - first() >= steps.size()) {
      throw InputError(file(), "", fmt::format("ends before {} {}; {}", step_word(), step + 1, remedy));
    }
    if (window != nullptr) require_window(*window);
    times_ = window == nullptr ? StepTimes{} : StepTimes{window->begin, window->end};
    return step_of_json(steps.at(step - first()), mesh, times_);
  });
}

StepResult DecidedShards::with_positions(StepResult result, int dimension, std::span<const Position> x_t0,
                                         std::span<const Position> x_t1) {
  reading(file(), [&] {
    for (const FeatureContact& contact : result.reports) require_meeting(contact, dimension, x_t0, x_t1);
    if (result.first) require_meeting(result.first->contact, dimension, x_t0, x_t1);
  });
  return result;
}

void DecidedShards::require_meeting(const FeatureContact& contact, int dimension, std::span<const Position> x_t0,
                                    std::span<const Position> x_t1) {
  const auto query = query_of(contact, dimension, x_t0, x_t1);
  if (visit(query, [](const auto& typed) { return meet(typed); })) return;
  throw std::invalid_argument("lists features that do not meet");
}

std::string DecidedShards::words_of(std::uint64_t task) const {
  return fmt::format("{}s {} to {}", step_word(), task * steps_of_chain + 1, (task + 1) * steps_of_chain);
}

void DecidedShards::open(std::uint64_t task) {
  if (!folder_.has(task)) {
    throw InputError(
        folder_.path().string(), "",
        fmt::format("{} is missing ({}); {}", folder_.shard(task).filename().string(), words_of(task), remedy));
  }
  task_ = task;
  shard_.emplace(folder_.shard(task), folder_.request_hash(), task);
  if (!of_run_) require_inputs();
  if (shard_->head().value("claim", Json()) != claim_) {
    throw InputError(file(), "", std::string("was made for another claim; remove it, and ") + remedy);
  }
}

void DecidedShards::require_inputs() const {
  if (const auto other = other_input(*shard_, files_)) {
    throw InputError(
        *other, "",
        fmt::format("is not the file that {} was made from: its SHA-256 differs; {}", on_one_line(file()), remedy));
  }
}

void DecidedShards::require_window(const RunWindow& window) {
  if (step_ == 0) first_window_ = hex(window.group_hash);
  const Json& known = shard_->head().at("windows");
  const bool same = known.at(1 + step_ - first()) == hex(window.group_hash);
  if (same && known.at(0) == first_window_) return;
  throw InputError(
      file(), "",
      fmt::format("was made when window {} had another hash than it has now; {}", same ? 1 : step_ + 1, remedy));
}

void DecidedShards::blocks(const std::function<void(FourLetters, std::string_view)>& take) {
  shard_->blocks(step_, take);
}

std::optional<ListedNear> DecidedShards::near(const Mesh& mesh) {
  return reading(file(), [&]() -> std::optional<ListedNear> {
    const Json& near = shard_->head().at("near");
    if (near.is_null() || near.at("step") != step_) return std::nullopt;
    return near_of_json(near, mesh);
  });
}

std::optional<LargestDistance> DecidedShards::largest_distance() {
  return reading(file(), [&]() -> std::optional<LargestDistance> {
    const Json& largest = shard_->head().at("largest_distance");
    if (largest.is_null()) return std::nullopt;
    return LargestDistance{largest.at("allowed").get<double>(), largest.at("limit").get<double>()};
  });
}

void DecidedShards::set_inputs(const std::vector<FrameFacts>& files) { files_ = files; }

void DecidedShards::set_claim(const Claim& claim) { claim_ = shared_claim_json(claim); }

StepResult DecidedParts::result(std::uint64_t /*step*/, const Mesh& mesh, const RunWindow* /*window*/) {
  std::vector<StepResult> parts;
  firsts_.clear();
  all_proved_ = true;
  for (std::uint64_t task = 0; task < parts_of_step; ++task) {
    open(task);
    reading(file(), [&] {
      const Json& steps = shard().head().at("steps");
      if (steps.size() != 1) throw std::invalid_argument(fmt::format("has {} steps; expected one", steps.size()));
      parts.push_back(step_of_json(steps.at(0), mesh, {}));
      if (shard().head().at("unproved").get<bool>()) all_proved_ = false;
    });
    if (parts.back().first) firsts_.push_back(*parts.back().first);
  }
  return sum_of(std::move(parts), max_reports_);
}

StepResult DecidedParts::with_positions(StepResult result, int dimension, std::span<const Position> x_t0,
                                        std::span<const Position> x_t1) {
  reading(scratch().string(), [&] {
    for (const FirstInStep& first : firsts_) require_meeting(first.contact, dimension, x_t0, x_t1);
    for (const FeatureContact& contact : result.reports) require_meeting(contact, dimension, x_t0, x_t1);
  });
  result.first = earliest_of(firsts_, dimension, x_t0, x_t1);
  return result;
}

void DecidedParts::blocks(const std::function<void(FourLetters, std::string_view)>& take) {
  for (std::uint64_t task = 0; task < parts_of_step && all_proved_; ++task) {
    open(task);
    shard().blocks(0, [&](FourLetters kind, std::string_view payload) {
      if (kind != ProofFile::step_kind) take(kind, payload);
    });
  }
}

std::string DecidedParts::words_of(std::uint64_t task) const {
  return fmt::format("part {} of {}", task + 1, parts_of_step);
}

}  // namespace noli
