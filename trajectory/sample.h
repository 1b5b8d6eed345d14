// SPDX-License-Identifier: Apache-2.0
//
// Samples world lines at a moment, in double precision.
//
// Samples are not the certified motion. At a breakpoint the position is exact; elsewhere it is rounded, and straight
// lines between two samples skip the breakpoints between them. For exact results use the segments (world_lines.h).
#pragma once

#include <vector>

#include <noli/mesh.h>
#include "trajectory/world_lines.h"

namespace noli {

/// The positions of all vertices at time t, each coordinate between those of the breakpoints around it. Precondition:
/// first_time() <= t <= last_time().
std::vector<Position> sample(const WorldLines& lines, double t);

/// The position of one vertex.
Position sample(const WorldLines& lines, VertexId v, double t);

/// Always between a and b, despite rounding: a for s = 0, b for s = 1. Precondition: 0 <= s <= 1.
Position sample_between(const Position& a, const Position& b, double s);

}  // namespace noli
