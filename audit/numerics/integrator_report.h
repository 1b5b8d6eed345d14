// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of `noli audit integrator`: text, JSON, and a figure of errors against run time.
#pragma once

#include <string>
#include <vector>

#include "audit/numerics/integrator_audit.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

using IntegratorResults = std::vector<IntegratorResult>;

/// "measured", "finding" (a run produced a value that is not finite), "undecided".
const char* integrator_verdict(const IntegratorResults& results);

report::Answer integrator_answer(const IntegratorResults& results);

Json integrator_json(const IntegratorResults& results);

/// For each scene, errors of trajectory, energy, momentum and angular momentum over run time, with a line for each
/// method. All axes are logarithmic.
std::string integrator_svg(const IntegratorResults& results);

}  // namespace noli::audit
