// SPDX-License-Identifier: Apache-2.0
//
// Decides exactly how near two features come along their world lines.
//
// Notation
//   piece   between two successive breakpoints of the features' vertices: all of them move linearly in it
//   gap     the least distance over all pieces; with the kernel's exact predicate "within eta at some time of the
//           piece" (kernel/thickness.h) it is found by bisection over the doubles
//
// A direction n with n . (a - b) >= g |n| for all points a, b at both ends of a piece shows, up to a bound of its
// rounding, that the features are farther apart than g in the piece. So most pieces are never decided exactly.
#pragma once

#include <array>

#include <noli/explain.h>
#include <noli/query.h>
#include "trajectory/world_lines.h"

namespace noli {

/// `vertices`: as in include/noli/query.h; the first point_count(pair) count. Precondition: such a pair exists in the
/// dimension, 2 or 3; the vertices are different. Throws std::range_error when the gap is above the greatest double.
ExactGap exact_gap(const WorldLines& lines, int dimension, FeaturePair pair, const std::array<VertexId, 4>& vertices);

}  // namespace noli
