// SPDX-License-Identifier: Apache-2.0
//
// Checkers in all ranks of a job: each rank looks at some of the parts of one proof (check_parts.h).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <noli/frames.h>
#include "certify/proofs/checker.h"
#include "certify/ranks/ranks.h"

namespace noli {

/// Checks one proof in all ranks; each rank must call it. The first rank returns the joined verdict if all were asked
/// the same and accept their parts; otherwise it checks the whole proof itself. Other ranks return nothing. `note`:
/// called in the first rank when a rank was asked something else or did not accept its part; not when the proof cannot
/// be shared. Precondition: request.proof. Throws as check_motion() and Ranks::gather().
std::optional<CheckerVerdict> check_in_ranks(CheckRequest request, const FrameReading& reading, Ranks& ranks,
                                             const std::function<void(const std::string&)>& note);

}  // namespace noli
