// SPDX-License-Identifier: Apache-2.0
//
// The text of `noli verify` for people: what touches in which step, what was looked at, and the verdict with its place.
#pragma once

#include <string>

#include <noli/verify.h>
#include "report/answer.h"

namespace noli::report {

/// Fills in text, details, next step and place. `result`: the file that the result is written to, or nothing.
void put_words(const VerifyRequest& request, const VerifyOutcome& outcome, const std::string& result, Answer& answer);

}  // namespace noli::report
