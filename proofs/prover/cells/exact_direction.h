// SPDX-License-Identifier: Apache-2.0
//
// Finds a direction that separates two parts in exact arithmetic, for parts for which doubles find none.
//
// Notation
//   D     the differences of a point of the first part and one of the second, at both ends of a piece of time and at
//         each breakpoint in between, multiplied by one positive number: integer vectors
//   least2  the square of the distance asked for, times the square of this number
//
// A direction n separates iff n.w > 0 and (n.w)^2 > least2 n.n for all w in D. If there is one, the point of the hull
// of D nearest to the origin is one. It is the nearest point of a hull of at most as many points as there are
// dimensions. So it is enough to try the directions given by one, two or three points of D.
//
// Doubles rule out most of these directions before exact arithmetic looks at them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kernel/arithmetic/integer.h"

namespace noli {

using IntegerVector = std::array<Integer, 3>;

/// The limit for a component: a sint (proofs/FORMAT.md, section 2) has 1,200 groups of seven bits. One bit is for the
/// sign, and one is reserved for a carry in rounding.
constexpr std::size_t most_direction_bits = 8398;

/// A direction that separates, with few bits; nothing if more than most_direction_bits are needed.
/// Precondition: `differences` is not empty.
std::optional<IntegerVector> exact_direction(const std::vector<IntegerVector>& differences, const Integer& least2);

}  // namespace noli
