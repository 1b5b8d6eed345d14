// SPDX-License-Identifier: Apache-2.0
//
// What `noli audit ccd --frames` says: text and JSON.
#pragma once

#include <string>

#include "noli/app/json.h"
#include "noli/audit/ccd_pipeline.h"

namespace noli::app {

std::string pipeline_text(const audit::PipelineOutcome& outcome);

Json pipeline_json(const audit::PipelineOutcome& outcome);

}  // namespace noli::app
