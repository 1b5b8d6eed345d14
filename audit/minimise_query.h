// SPDX-License-Identifier: Apache-2.0
//
// Makes a failing query simpler while it still fails.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "noli/audit/any_query.h"

namespace noli::audit {

/// How complicated a number is: 0 for +0.0, else what it takes to write it down in binary (significant bits, distance
/// of the exponent from 0, sign).
int complexity(double x);

/// Values to try in place of x, the simplest first; they may be more complicated than x, or infinite.
std::vector<double> simpler_numbers(double x);

/// The sum over all coordinates that count.
int complexity(const AnyQuery& query);

/// A query for which `fails` holds and that none of these steps makes simpler: a point that stands still, points that
/// coincide, an axis scaled to unit size, and each coordinate zero, without its sign, a whole number, or with fewer
/// bits. Stops early after `budget` calls of `fails`. Precondition: fails(query).
AnyQuery minimise(const AnyQuery& query, const std::function<bool(const AnyQuery&)>& fails, std::size_t budget = 20000);

}  // namespace noli::audit
