// SPDX-License-Identifier: Apache-2.0
//
// The words of `noli verify`: its JSON, and its text for people with a first line for machines.
#pragma once

#include <string>

#include "noli/app/json.h"
#include "noli/app/verify_run.h"

namespace noli::app {

/// All of it. Everything that a clock or the machine decides is under "timing"; the rest depends on the input and on
/// the options that `statement` repeats alone.
Json verify_json(const VerifyRequest& request, const VerifyOutcome& outcome);

/// The verdict line, then the same for people.
std::string verify_text(const VerifyRequest& request, const VerifyOutcome& outcome);

}  // namespace noli::app
