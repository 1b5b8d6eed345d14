// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "certify/json.h"
#include "certify/run_explanation.h"
#include "report/answer.h"

namespace noli::report {

Json to_json(const RunExplanation& explanation);
/// `json`: that of to_json.
Answer answer_of(const Json& json, const RunExplanation& explanation);

}  // namespace noli::report
