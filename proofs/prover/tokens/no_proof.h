// SPDX-License-Identifier: Apache-2.0
//
// What a proof is given up for.
#pragma once

#include <stdexcept>

namespace noli {

/// Two parts for which no direction was found, however short the piece.
struct NoProof : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace noli
