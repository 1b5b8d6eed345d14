// SPDX-License-Identifier: Apache-2.0
//
// Do the hulls of two small sets of points meet? In rational arithmetic, by Caratheodory's theorem.
//
// They do iff the origin is in the hull of the differences of their points, and then it is in the hull of at most four
// of these that are affinely independent. All such subsets are tried.
#pragma once

#include <vector>

#include <noli/mesh.h>

namespace noli::testing {

bool hulls_meet(const std::vector<Position>& p, const std::vector<Position>& q);

}  // namespace noli::testing
