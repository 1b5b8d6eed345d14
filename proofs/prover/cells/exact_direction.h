// SPDX-License-Identifier: Apache-2.0
//
// A direction that separates two parts, in exact arithmetic: what is left where doubles see none.
//
// Notation
//   D     the differences of a point of the first part and one of the second, at both ends of a piece of time and at
//         each breakpoint between, all times the same positive number: integer vectors
//   least2  the square of the distance asked for, times that of this number
//
// A direction n separates iff n.w > 0 and (n.w)^2 > least2 n.n for all w in D. If there is one, the point of the hull
// of D nearest to the origin is one, and it is the nearest point of a hull of at most as many points as there are
// dimensions: so it is enough to look at the directions that one, two or three points of D give.
//
// What this does not do: it is not fast; it takes some 10 ms for 18 differences.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kernel/arithmetic/integer.h"

namespace noli {

using IntegerVector = std::array<Integer, 3>;

/// Of a component: a sint (proofs/FORMAT.md, section 2) has 1,200 groups of seven bits, one of them for the sign, and
/// one is left for what rounding carries.
constexpr std::size_t most_direction_bits = 8398;

/// A direction that separates, with as few bits as are enough; nothing if more than most_direction_bits are needed.
/// Precondition: `differences` is not empty.
std::optional<IntegerVector> exact_direction(const std::vector<IntegerVector>& differences, const Integer& least2);

}  // namespace noli
