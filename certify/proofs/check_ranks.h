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

/// Checks one proof in all ranks; each rank must call it. Returns the joined verdict in the first rank if all were
/// asked the same and accept; otherwise the first rank checks the whole proof. Returns nothing in other ranks. `note`:
/// called in the first rank with the reason for that. Precondition: request.proof. Throws as check_motion() and
/// Ranks::gather().
std::optional<CheckerVerdict> check_in_ranks(CheckRequest request, const FrameReading& reading, Ranks& ranks,
                                             const std::function<void(const std::string&)>& note);

}  // namespace noli
