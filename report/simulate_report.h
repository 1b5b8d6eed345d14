// SPDX-License-Identifier: Apache-2.0
//
// The words of `noli simulate`.
#pragma once

#include <noli/simulate.h>
#include "certify/json.h"
#include "report/answer.h"

namespace noli::report {

Json simulate_json(const SimulateRequest& request, const SimulateOutcome& outcome);

/// The same in words; the place of the verdict is a window and a time. `json`: that of simulate_json.
Answer simulate_answer(const Json& json, const SimulateRequest& request, const SimulateOutcome& outcome);

/// What `noli simulate --reproduce` found.
Json reproduce_json(const ReproduceRequest& request, const ReproduceOutcome& outcome);

/// `json`: that of reproduce_json. Precondition: the request has an output.
Answer reproduce_answer(const Json& json, const ReproduceRequest& request);

}  // namespace noli::report
