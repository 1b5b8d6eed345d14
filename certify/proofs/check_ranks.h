// SPDX-License-Identifier: Apache-2.0
//
// Checkers in all ranks of a job: each rank looks at some of the parts of one proof (check_parts.h).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "certify/proofs/checker.h"
#include "certify/ranks/ranks.h"
#include "trajectory/formats/frame_source.h"

namespace noli {

/// check_motion() (check_frames.h) by all ranks, which call it with the same request: their joined verdict if all were
/// asked the same and accept, otherwise that of one checker of the first rank. Nothing for the other ranks. `note`:
/// called in the first rank with why it checks the whole proof. Throws as check_motion() and Ranks::gather().
std::optional<CheckerVerdict> check_in_ranks(CheckRequest request, const FrameReading& reading, Ranks& ranks,
                                             const std::function<void(const std::string&)>& note);

}  // namespace noli
