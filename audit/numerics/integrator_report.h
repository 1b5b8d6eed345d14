// SPDX-License-Identifier: Apache-2.0
//
// What `noli audit integrator` says: text, JSON, and a picture of errors against run time.
#pragma once

#include <string>
#include <vector>

#include "audit/numerics/integrator_audit.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

using IntegratorResults = std::vector<IntegratorResult>;

/// "measured", "finding" (a run left the numbers), "undecided".
const char* integrator_verdict(const IntegratorResults& results);

report::Answer integrator_answer(const IntegratorResults& results);

Json integrator_json(const IntegratorResults& results);

/// For each scene, errors of trajectory, energy, momentum and angular momentum over run time, all logarithmic: a line
/// for each method.
std::string integrator_svg(const IntegratorResults& results);

}  // namespace noli::audit
