// SPDX-License-Identifier: Apache-2.0
//
// How many windows reach up to a time.
#pragma once

#include <cmath>

namespace noli::integrator {

/// A time that is a whole number of windows except for rounding, as 0.07 of 0.01, takes just that number.
inline double windows_up_to(double time, double window) { return std::ceil(time / window * (1 - 0x1p-50)); }

}  // namespace noli::integrator
