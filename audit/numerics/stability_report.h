// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of `noli audit stability`: text and JSON.
#pragma once

#include "audit/numerics/stability.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

/// `seconds` of the whole audit, wall clock, become part of `timing`.
Json stability_json(const StabilityReport& report, double seconds);

/// `json`: what stability_json() returned for this report.
report::Answer stability_answer(const Json& json, const StabilityReport& report, double seconds);

}  // namespace noli::audit
