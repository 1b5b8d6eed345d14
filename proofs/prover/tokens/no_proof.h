// SPDX-License-Identifier: Apache-2.0
//
// The error when the search for a proof gives up.
#pragma once

#include <stdexcept>

namespace noli {

/// No direction was found for two parts, however short the piece.
struct NoProof : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace noli
