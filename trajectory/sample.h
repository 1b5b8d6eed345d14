// SPDX-License-Identifier: Apache-2.0
//
// Where world lines are at a moment, in double precision.
//
// What this is not: the certified motion. At a breakpoint the position is exact; between two it is rounded, and
// straight lines between two samples leave out every breakpoint between them. Exact users take the segments
// (world_lines.h).
#pragma once

#include <vector>

#include <noli/mesh.h>
#include "trajectory/world_lines.h"

namespace noli {

/// The positions of all vertices at time t, each coordinate between those of the breakpoints around it. Precondition:
/// first_time() <= t <= last_time().
std::vector<Position> sample(const WorldLines& lines, double t);

/// That of one vertex.
Position sample(const WorldLines& lines, VertexId v, double t);

/// Between a and b, whatever the rounding: a for s = 0, b for s = 1. Precondition: 0 <= s <= 1.
Position sample_between(const Position& a, const Position& b, double s);

}  // namespace noli
