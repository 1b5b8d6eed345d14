// SPDX-License-Identifier: Apache-2.0
//
// What one task of the verification of a window has found; the tallies of all tasks, added up in order, are the result.
#pragma once

#include "proofs/prover/tally.h"
#include "proofs/prover/window_earliest.h"

namespace noli {

using WindowTally = TallyWith<WindowEarliest>;

}  // namespace noli
