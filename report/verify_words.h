// SPDX-License-Identifier: Apache-2.0
//
// The text of `noli verify` for people: what touches in which step, what was looked at, and the verdict with its place.
#pragma once

#include <cstddef>
#include <string>

#include <noli/verify.h>
#include "report/answer.h"

namespace noli::report {

/// "step 3 (c.ply → d.ply)", "frame 3 (c.ply)", "window 3"; `number`: from 1.
std::string step_name(const VerifyRequest& request, std::size_t number);

/// Precondition: the outcome is not complete.
const char* why_incomplete(const VerifyOutcome& outcome);

/// Fills in text, details, next step and place.
void put_words(const VerifyRequest& request, const VerifyOutcome& outcome, Answer& answer);

}  // namespace noli::report
