// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/decided_parts.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "certify/shards/shards.h"
#include "certify/step_parts.h"
#include "proofs/prover/tokens/proof_file.h"

namespace noli {

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
