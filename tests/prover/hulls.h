// SPDX-License-Identifier: Apache-2.0
//
// Decides in rational arithmetic whether the hulls of two small sets of points meet.
//
// They do iff the origin is in the hull of the differences of their points. By Caratheodory's theorem, it is then in
// the hull of at most four affinely independent differences. All such subsets are tried.
#pragma once

#include <vector>

#include <noli/mesh.h>

namespace noli::testing {

bool hulls_meet(const std::vector<Position>& p, const std::vector<Position>& q);

}  // namespace noli::testing
