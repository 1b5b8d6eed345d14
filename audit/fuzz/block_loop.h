// SPDX-License-Identifier: Apache-2.0
//
// Work in blocks, many at a time, taken over in order: so that what comes of it is the same for any number of threads.
//
// Notation
//   block b    queries_per_block queries (the last block of a counted run: fewer), which depend on the seed and b alone
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/parallel.h"

namespace noli::audit {

constexpr std::size_t queries_per_block = 256;

/// When a run ends. At least one of count, time limit and stop flag has to be given.
struct BlockLimits {
  std::optional<std::uint64_t> count;                       ///< queries
  std::optional<std::chrono::duration<double>> time_limit;  ///< looked at after every few blocks
  int threads = 0;                                          ///< <= 0: all there are
  const std::atomic<bool>* stop = nullptr;                  ///< polled after every few blocks
};

enum class BlockEnd { limit, interrupted, enough };

/// Calls make(block, queries), from several threads, and take(result), from this one and in the order of the blocks,
/// until a limit is reached or `take` returns false; after(seconds) now and then.
template <class Make, class Take, class After>
BlockEnd run_blocks(const BlockLimits& limits, const Make& make, const Take& take, const After& after) {
  using Clock = std::chrono::steady_clock;
  using Result = decltype(make(std::uint64_t{}, std::size_t{}));
  const Clock::time_point begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const auto threads = static_cast<std::uint64_t>(limits.threads > 0 ? limits.threads : hardware_threads());
  std::uint64_t next = 0, left = limits.count.value_or(std::uint64_t{1} << 60);
  std::uint64_t batch = threads;  // few at first, for who stops at the first finding
  for (;;) {
    if (limits.stop != nullptr && limits.stop->load()) return BlockEnd::interrupted;
    if (left == 0 || (limits.time_limit && seconds() >= limits.time_limit->count())) return BlockEnd::limit;
    const std::uint64_t blocks_left = (left + queries_per_block - 1) / queries_per_block;
    std::vector<Result> results(std::min(batch, blocks_left));
    batch = std::min(2 * batch, 8 * threads);
    parallel_for(results.size(), static_cast<int>(threads), [&](std::size_t i) {
      results[i] = make(next + i, std::min<std::uint64_t>(queries_per_block, left - i * queries_per_block));
    });
    for (Result& result : results) {
      if (!take(std::move(result))) return BlockEnd::enough;
    }
    next += results.size();
    left -= std::min<std::uint64_t>(left, results.size() * queries_per_block);
    after(seconds());
  }
}

}  // namespace noli::audit
