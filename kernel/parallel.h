// SPDX-License-Identifier: Apache-2.0
//
// The parallel layer: one loop over independent tasks. Backed by oneTBB, or by std::thread where the build says so
// (NOLI_PARALLEL=STD, for ThreadSanitizer, which oneTBB is not instrumented for). Both give the same results because tasks may only
// write what belongs to their own index.
#pragma once

#include <cstddef>
#include <functional>

namespace noli {

/// Number of threads the machine offers; at least 1.
int hardware_threads();

/// Calls task(i) once for each i in [0, count), from at most `threads` threads, in any order. `threads` <= 0 means all there are.
/// Returns when all calls have returned. When tasks throw, the remaining ones may be skipped, and one of the exceptions
/// (that of the lowest index among those thrown) is rethrown here.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

}  // namespace noli
