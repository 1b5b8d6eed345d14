// SPDX-License-Identifier: Apache-2.0
//
// The parallel layer: one loop over independent tasks. It uses oneTBB, or std::thread if NOLI_PARALLEL=STD is set at
// build time (for ThreadSanitizer, as oneTBB is not instrumented for it). Both give the same results because tasks may
// only write what belongs to their own index.
//
// Reductions are in order (merged_over; or write to slot i and add up afterwards). Only an exception cancels a loop.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace noli {

/// Number of threads the machine offers; at least 1.
int hardware_threads();

/// Calls task(i) once for each i in [0, count), from at most `threads` threads, the caller's among them; tasks start in
/// ascending order and end in any order. `threads` <= 0 means all there are. Returns when all calls have returned. If
/// tasks throw, the exception of the lowest index that throws is rethrown here; tasks of a higher index may then be
/// skipped, those of a lower one are not. Calls may be nested. Also throws std::system_error or std::bad_alloc when the
/// machine has no thread or memory left.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

/// Calls each(i) for each i in [0, count), `piece` consecutive ones in one task: for many small items that do not
/// depend on each other.
template <class Each>
void for_each_in_pieces(std::size_t count, int threads, const Each& each, std::size_t piece = 2048) {
  parallel_for((count + piece - 1) / piece, threads, [&](std::size_t p) {
    const std::size_t end = std::min(count, (p + 1) * piece);
    for (std::size_t i = p * piece; i < end; ++i) each(i);
  });
}

/// Merges of(i) for each i in [0, count) with merged(a, b), starting from `none`, the neutral element. The order does
/// not depend on threads. One task takes `piece` consecutive indices.
template <class T, class Of>
T merged_over(std::size_t count, int threads, const T& none, const Of& of, std::size_t piece = 1024) {
  std::vector<T> parts((count + piece - 1) / piece, none);
  parallel_for(parts.size(), threads, [&](std::size_t p) {
    T sum = none;
    for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i) sum = merged(sum, of(i));
    parts[p] = sum;
  });
  T sum = none;
  for (const T& part : parts) sum = merged(sum, part);
  return sum;
}

/// Calls both, at the same time unless `threads` is 1, and returns when both have returned; exceptions as in
/// parallel_for, `first` before `second`. The other thread is a plain one for every back end: the first loop of a
/// process loads the back end, and the other function should not wait for that.
void parallel_both(int threads, const std::function<void()>& first, const std::function<void()>& second);

/// One way to get threads. `run` has the contract of parallel_for.
struct ParallelBackend {
  std::string_view name;  ///< "tbb" or "std"
  void (*run)(std::size_t count, int threads, const std::function<void(std::size_t)>& task);
};

/// The back ends of this build, "std" always among them. parallel_for uses the first.
std::span<const ParallelBackend> parallel_backends();

}  // namespace noli
