// SPDX-License-Identifier: Apache-2.0
//
// Makes a failing query simpler while it still fails: few different numbers, each of them short.
//
// What this does not do: it finds no least query, only one that none of its steps makes simpler.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "certify/queries/any_query.h"

namespace noli::audit {

/// How complicated a number is: 0 for +0.0, else what it takes to write it down in binary (significant bits, distance
/// of the exponent from 0, sign).
int complexity(double x);

/// Values to try in place of x, the simplest first; they may be more complicated than x, or infinite.
std::vector<double> simpler_numbers(double x);

/// The sum over all coordinates that count.
int complexity(const AnyQuery& query);

/// How many different numbers there are among the coordinates that count. -0.0 and 0.0 are one.
std::size_t distinct_coordinates(const AnyQuery& query);

/// The first of some candidates that still fails, if one does. Who is asked often asks cheaply for many at a time.
using FirstFailure = std::function<std::optional<std::size_t>(std::span<const AnyQuery>)>;

/// Candidates that are looked at before `minimise` is content.
constexpr std::size_t usual_shrink_budget = 60000;

/// A query that fails and that none of these steps makes simpler: a point that stands still, also along one axis,
/// points that coincide, a point moved along the difference of two others, half the step, an axis left out, scaled to
/// unit size, moved, or sheared along another, a number that takes the place of another everywhere, and each coordinate
/// zero, without its sign, a whole number, or with fewer bits. Simpler: the sum of `complexity` and a price for each
/// different number is less. Stops early after `budget` candidates. Precondition: the query fails.
AnyQuery minimise(const AnyQuery& query, const FirstFailure& first_failure, std::size_t budget = usual_shrink_budget);

/// The same, asking one after the other.
AnyQuery minimise(const AnyQuery& query, const std::function<bool(const AnyQuery&)>& fails,
                  std::size_t budget = usual_shrink_budget);

}  // namespace noli::audit
