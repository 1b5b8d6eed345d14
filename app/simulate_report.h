// SPDX-License-Identifier: Apache-2.0
//
// The words of `noli simulate`.
#pragma once

#include <string>

#include "app/answer.h"
#include "app/exit_code.h"
#include "app/json.h"
#include "app/simulate_run.h"

namespace noli::app {

Json simulate_json(const SimulateRequest& request, const SimulateOutcome& outcome);

/// The same in words; the place of the verdict is a window and a time.
Answer simulate_answer(const SimulateRequest& request, const SimulateOutcome& outcome);

ExitCode exit_code(const SimulateOutcome& outcome);

}  // namespace noli::app
