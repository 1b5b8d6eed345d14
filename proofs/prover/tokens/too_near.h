// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace noli {

/// Two cells that come nearer to each other than the least distance, as far as doubles see, and a time at which they
/// are.
struct TooNear {
  std::uint32_t first_cell, second_cell;
  double time;  ///< in [0, 1] of the step
};

}  // namespace noli
