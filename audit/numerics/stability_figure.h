// SPDX-License-Identifier: Apache-2.0
//
// A picture of what `noli audit stability` found: a line of boxes for each row, from the ordinary to the extreme.
#pragma once

#include <string>

#include "audit/numerics/stability.h"

namespace noli::audit {

/// Each box has its value, and the energy error if there is one. Green: holds; yellow: fails closed, with the reason;
/// red: a finding.
std::string stability_svg(const StabilityReport& report);

}  // namespace noli::audit
