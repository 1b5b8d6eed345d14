// SPDX-License-Identifier: Apache-2.0
//
// Runs a measurement in a process of its own, so that its peak memory is its own.
#pragma once

#include <functional>

namespace noli::bench {

struct Measured {
  double seconds = 0;     ///< what the measurement returned
  double peak_bytes = 0;  ///< largest resident size of the process
};

/// Forks, calls `measure` there and returns what it returned. Throws std::runtime_error when the child fails.
Measured in_child(const std::function<double()>& measure);

}  // namespace noli::bench
