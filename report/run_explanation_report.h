// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "certify/json.h"
#include "certify/run_explanation.h"
#include "report/answer.h"

namespace noli::report {

Answer answer_of(const RunExplanation& explanation);
Json to_json(const RunExplanation& explanation);

}  // namespace noli::report
