// SPDX-License-Identifier: Apache-2.0
//
// What `noli audit integrator` says: text, JSON, and a picture of errors against run time.
#pragma once

#include <string>
#include <vector>

#include "app/answer.h"
#include "app/json.h"
#include "audit/integrator_audit.h"

namespace noli::app {

using IntegratorResults = std::vector<audit::IntegratorResult>;

/// "measured", "finding" (a run left the numbers), "undecided".
const char* integrator_verdict(const IntegratorResults& results);

Answer integrator_answer(const IntegratorResults& results);

Json integrator_json(const IntegratorResults& results);

/// For each scene, errors of trajectory, energy, momentum and angular momentum over run time, all logarithmic: a line
/// for each method.
std::string integrator_svg(const IntegratorResults& results);

}  // namespace noli::app
