// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of `noli audit self`: text and JSON.
#pragma once

#include "audit/numerics/self.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

/// `seconds` of the whole audit, wall clock, become part of `timing`.
Json self_json(const SelfOptions& options, const SelfReport& report, double seconds);

/// `json`: what self_json() returned for this report.
report::Answer self_answer(const Json& json, const SelfReport& report, double seconds);

}  // namespace noli::audit
