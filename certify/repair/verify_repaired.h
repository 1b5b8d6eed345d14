// SPDX-License-Identifier: Apache-2.0
//
// The last word on a repair: what `noli verify` says of the files that were written.
#pragma once

#include <noli/repair.h>

namespace noli {

/// Verifies the frames of outcome.written, with their proof and its checker, and notes what is said in the outcome.
/// Throws std::runtime_error when a file is not what was written, and what run_verify() throws.
void verify_repaired(const RepairRequest& request, RepairOutcome& outcome);

}  // namespace noli
