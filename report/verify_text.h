// SPDX-License-Identifier: Apache-2.0
//
// The text of `noli verify` for people: what touches in which step, what was looked at, and the verdict with its place.
#pragma once

#include <string>

#include <noli/verify.h>
#include "report/answer.h"

namespace noli::report {

/// What is to be said besides the verdict.
struct TextOptions {
  std::string result;    ///< the file that the result is written to, for the advice on what to do next; or nothing
  bool details = false;  ///< those that --verbose shows: of 10,000 frames, they are megabytes
};

/// Fills in text, details, next step and place.
void put_text(const VerifyRequest& request, const VerifyOutcome& outcome, TextOptions wanted, Answer& answer);

}  // namespace noli::report
