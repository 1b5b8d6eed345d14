// SPDX-License-Identifier: Apache-2.0
//
// The words of `noli simulate`.
#pragma once

#include <string>

#include "noli/app/answer.h"
#include "noli/app/exit_code.h"
#include "noli/app/json.h"
#include "noli/app/simulate_run.h"

namespace noli::app {

Json simulate_json(const SimulateRequest& request, const SimulateOutcome& outcome);

/// The same in words; the place of the verdict is a window and a time.
Answer simulate_answer(const SimulateRequest& request, const SimulateOutcome& outcome);

ExitCode exit_code(const SimulateOutcome& outcome);

}  // namespace noli::app
