// SPDX-License-Identifier: Apache-2.0
//
// What `noli audit ccd --frames` says: text and JSON.
#pragma once

#include <string>

#include "audit/ccd/ccd_pipeline.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

Json pipeline_json(const PipelineOutcome& outcome);

/// `json`: that of pipeline_json.
report::Answer pipeline_answer(const Json& json, const PipelineOutcome& outcome);

}  // namespace noli::audit
