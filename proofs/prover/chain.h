// SPDX-License-Identifier: Apache-2.0
//
// Chains of steps: what a step takes over from the one before, it takes over within its chain alone.
//
// Notation
//   chain     the steps 16 c to 16 c + 15 of a sequence, c = 0, 1, ...
//   cold      the first step of a chain starts with nothing: its tree is made anew
//
// So each chain can be decided by itself, on any thread or machine, and all of them give the same findings and the same
// bytes of a proof as one process that goes from the first step to the last.
#pragma once

#include <cstdint>
#include <memory>

namespace noli {

inline constexpr std::uint64_t steps_of_chain = 16;

/// Whether step k = 0, 1, ... is the first of its chain.
constexpr bool starts_chain(std::uint64_t step) { return step % steps_of_chain == 0; }

/// What verify_step() leaves for the next step of the chain, or for another part of the same step: the tree, and room
/// for all that a step needs.
struct ChainMemory {
  ChainMemory() = default;
  virtual ~ChainMemory() = default;
  ChainMemory(const ChainMemory&) = delete;
  ChainMemory& operator=(const ChainMemory&) = delete;
};

}  // namespace noli
