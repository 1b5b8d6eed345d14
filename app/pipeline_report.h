// SPDX-License-Identifier: Apache-2.0
//
// What `noli audit ccd --frames` says: text and JSON.
#pragma once

#include <string>

#include "app/answer.h"
#include "app/json.h"
#include "audit/ccd_pipeline.h"

namespace noli::app {

Answer pipeline_answer(const audit::PipelineOutcome& outcome);

Json pipeline_json(const audit::PipelineOutcome& outcome);

}  // namespace noli::app
