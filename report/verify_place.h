// SPDX-License-Identifier: Apache-2.0
//
// Where and by whom: what stands behind the verdict of `noli verify`, and how its steps are called.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <noli/verify.h>

namespace noli::report {

/// How many steps: "steps", "frames at rest", "windows".
const char* steps_word(const VerifyRequest& request, std::size_t count);

/// "c.ply → d.ply", "c.ply" for a frame at rest, nothing for a window; `number`: from 1.
std::string step_frames(const VerifyRequest& request, const VerifyOutcome& outcome, std::size_t number);

/// "step 3 (c.ply → d.ply)", "frame 3 (c.ply)", "window 3".
std::string step_name(const VerifyRequest& request, const VerifyOutcome& outcome, std::size_t number);

/// "1 pair", "2 pairs"
std::string plural(std::uint64_t count, const char* thing);

/// Whether cells intersect before, or where, the first pair of features meets.
bool intersects_first(const VerifyOutcome& outcome);

/// Precondition: the outcome is not complete.
const char* why_incomplete(const VerifyOutcome& outcome);

/// "nothing touches", and what makes that weaker: pairs that are not compared, dimensions, particles. Precondition: the
/// verdict says so.
std::string nothing_touches_text(const VerifyOutcome& outcome);

/// One line, without the verdict itself.
std::string place_of(const VerifyRequest& request, const VerifyOutcome& outcome);

}  // namespace noli::report
