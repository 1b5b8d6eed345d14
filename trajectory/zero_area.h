// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trajectory/mesh.h"

namespace noli {

/// Whether three points are on one line, exactly. Precondition: finite.
bool has_zero_area(const Position& a, const Position& b, const Position& c);

}  // namespace noli
