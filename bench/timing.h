// SPDX-License-Identifier: Apache-2.0
//
// What benchmarks measure with where Google Benchmark's own loop does not fit.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace noli::bench {

/// A steady clock.
inline double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Precondition: not empty.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace noli::bench
