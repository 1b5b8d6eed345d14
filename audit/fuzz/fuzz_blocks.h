// SPDX-License-Identifier: Apache-2.0
//
// The loop of a fuzzer: blocks of items, made and judged by several threads, taken over in order.
//
// Notation
//   block    a few items; block b depends on the seed and b alone, so that a run gives the same items whatever the
//            number of threads
//
// What this does not do: it knows nothing of what an item is.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "kernel/parallel.h"

namespace noli::audit {

/// When a fuzzer stops. At least one of count, time_limit and stop has to be given.
struct FuzzLimits {
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> count;                       ///< after so many items
  std::optional<std::chrono::duration<double>> time_limit;  ///< after that time, at the end of a few blocks
  int threads = 0;                                          ///< <= 0: all there are
  const std::atomic<bool>* stop = nullptr;                  ///< polled after every few blocks
  /// Called from the caller's thread now and then, with the share of the run that is done.
  std::function<void(double)> progress;
};

/// How far a fuzzer came.
struct FuzzExtent {
  std::uint64_t items = 0;
  bool interrupted = false;  ///< by the stop flag
};

/// Calls make(block, items), which returns what one block gave, from several threads, and take(that) from the caller's,
/// in the order of blocks, until a limit is reached or `take`, where it returns a bool, returns false. Throws
/// std::invalid_argument when no limit is given, and what `make` and `take` throw.
template <class Make, class Take>
FuzzExtent fuzz_blocks(const FuzzLimits& limits, std::uint64_t items_per_block, const Make& make, const Take& take) {
  if (!limits.count && !limits.time_limit && !limits.stop) {
    throw std::invalid_argument("a fuzzer with neither count, nor time limit, nor stop flag");
  }
  using Result = decltype(make(std::uint64_t{}, std::uint64_t{}));
  const auto begin = std::chrono::steady_clock::now();
  const auto threads = static_cast<std::uint64_t>(limits.threads > 0 ? limits.threads : hardware_threads());
  FuzzExtent extent;
  for (std::uint64_t block = 0;;) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double by_time = limits.time_limit ? seconds / limits.time_limit->count() : 0;
    const double by_count = limits.count ? static_cast<double>(extent.items) / static_cast<double>(*limits.count) : 0;
    if (limits.progress) limits.progress(std::min(1.0, std::max(by_time, by_count)));
    extent.interrupted = limits.stop && limits.stop->load();
    if (extent.interrupted || by_time >= 1 || by_count >= 1) return extent;
    const std::uint64_t left = limits.count ? *limits.count - extent.items : std::uint64_t{1} << 60;
    std::vector<Result> results(std::min(2 * threads, (left + items_per_block - 1) / items_per_block));
    parallel_for(results.size(), static_cast<int>(threads), [&](std::size_t i) {
      results[i] = make(block + i, std::min<std::uint64_t>(items_per_block, left - i * items_per_block));
    });
    extent.items += std::min<std::uint64_t>(left, results.size() * items_per_block);
    block += results.size();
    for (Result& result : results) {
      if constexpr (std::is_void_v<decltype(take(std::move(result)))>) {
        take(std::move(result));
      } else if (!take(std::move(result))) {
        return extent;
      }
    }
  }
}

}  // namespace noli::audit
