// SPDX-License-Identifier: Apache-2.0
//
// Describes results of `noli ccd` as JSON and as text.
#pragma once

#include "certify/json.h"
#include "certify/queries/ccd_run.h"
#include "report/answer.h"

namespace noli::report {

/// Schema ccd.
Json ccd_json(const CcdRequest& request, const CcdOutcome& outcome);

/// `json`: that of ccd_json().
Answer ccd_answer(const Json& json, const CcdOutcome& outcome);

}  // namespace noli::report
