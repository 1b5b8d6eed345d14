// SPDX-License-Identifier: Apache-2.0
//
// What a proof is given up for.
#pragma once

#include <cstdint>
#include <stdexcept>

namespace noli {

/// Two parts for which no direction was found, however short the piece.
struct NoProof : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Two cells that come nearer to each other than the least distance, as far as doubles see, and a time at which they
/// are.
struct TooNear {
  std::uint32_t first_cell, second_cell;
  double time;  ///< in [0, 1] of the step
};

}  // namespace noli
