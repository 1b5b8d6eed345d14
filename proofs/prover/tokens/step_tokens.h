// SPDX-License-Identifier: Apache-2.0
//
// The output of the walk over a step, from which its proof is made.
//
// Most obligations are closed by a direction that the walk finds. Parts for which it finds none must be cut into short
// pieces of time, which takes long, and never ends if they meet. So this waits until the whole step is known to have no
// contact.
#pragma once

#include <optional>
#include <vector>

#include "proofs/prover/cells/direction.h"
#include "proofs/prover/tokens/tokens.h"

namespace noli {

class StopSignal;

/// Parts of two cells without a common vertex, or of one cell, for which no direction was found.
template <int Dim>
struct OpenParts {
  std::size_t at;  ///< where their tokens belong
  const StepCell<Dim>* a;
  const StepCell<Dim>* b;
  CornerMask a_part, b_part;
};

/// `Out`: Tokens, or NoTokens.
template <int Dim, class Out>
struct WalkTokens {
  Out tokens;
  std::vector<OpenParts<Dim>> open;  ///< incomplete after a contact was found
};

/// The tokens for parts that do not meet. Nothing if none were found, which takes long, or if it was stopped.
template <int Dim>
std::optional<Tokens> prove_apart(const OpenParts<Dim>& parts, const StopSignal& stop);

}  // namespace noli
