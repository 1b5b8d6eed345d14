// SPDX-License-Identifier: Apache-2.0
//
// What `noli audit precision` says: text, JSON, and a picture of drifts over time.
#pragma once

#include <string>

#include "audit/numerics/precision.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

/// "same": 53 bits yield double, bit for bit, in all windows; "differs"; "undecided": not all windows were run.
const char* precision_verdict(const PrecisionOutcome& outcome);

report::Answer precision_answer(const PrecisionOutcome& outcome);

/// Without `timing`.
Json precision_json(const PrecisionOutcome& outcome);

/// From above: how far double is from the other precisions in position, energy, momentum and angular momentum, and what
/// of its energy error is truncation and what rounding. All over time, on logarithmic scales, with a line where the
/// order of events changes.
std::string precision_svg(const PrecisionOutcome& outcome, const std::string& title);

}  // namespace noli::audit
