// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of `noli audit self`: text and JSON.
#pragma once

#include <string_view>

#include "audit/numerics/self.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

/// "finding": a part failed; "holds": all that ran held, and something did; else "undecided". With `require_all`,
/// nothing may have been skipped.
const char* self_verdict(const SelfReport& report, bool require_all);

/// `seconds` of the whole audit, wall clock, become part of `timing`.
Json self_json(const SelfOptions& options, const SelfReport& report, std::string_view verdict, double seconds);

/// Precondition: `json` is that of the report.
report::Answer self_answer(const Json& json, const SelfReport& report, double seconds);

}  // namespace noli::audit
