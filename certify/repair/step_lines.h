// SPDX-License-Identifier: Apache-2.0
//
// The motion of a repaired step as the window of a run (trajectory/FORMAT.md).
//
// Notation
//   k   the step, from 0; its window goes from the time k to k + 1
//
// In two dimensions a run has no third coordinate: it is 0 in these lines.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "certify/repair/step_filter.h"
#include "trajectory/world_lines.h"

namespace noli {

/// As the vertices moved, from x. Times are sums of k and a time in the step, rounded: of breakpoints that fall on one
/// time the last one counts. So this motion is close to that of the filter, and has to be decided by itself.
WorldLines lines_of_step(const FilteredStep& moved, std::span<const Position> x, std::size_t k, int dimension);

/// On straight lines from x through frames at these times in (0, 1], whose last is 1. Precondition: times are multiples
/// of 2^-20, and k is below 2^32, so that their sums are exact.
WorldLines lines_through_frames(std::span<const Position> x, std::span<const double> times,
                                std::span<const std::vector<Position>> frames, std::size_t k, int dimension);

}  // namespace noli
