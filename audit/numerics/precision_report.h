// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of `noli audit precision`: text, JSON, and a figure of drifts over time.
#pragma once

#include <string>

#include "audit/numerics/precision.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

/// "same": 53 bits reproduce double, bit for bit, in all windows; "differs"; "undecided": not all windows were run.
const char* precision_verdict(const PrecisionOutcome& outcome);

report::Answer precision_answer(const PrecisionOutcome& outcome);

/// Without `timing`.
Json precision_json(const PrecisionOutcome& outcome);

/// From top to bottom: the distance of double from the other precisions in position, energy, momentum and angular
/// momentum, then truncation and rounding in its energy error. All are plotted over time on logarithmic scales, with a
/// line where the order of events changes.
std::string precision_svg(const PrecisionOutcome& outcome, const std::string& title);

}  // namespace noli::audit
