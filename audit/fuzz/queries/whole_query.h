// SPDX-License-Identifier: Apache-2.0
//
// Queries with whole numbers as coordinates, small enough that every step of their construction is exact.
//
// Notation
//   p, q        directions, from which the points at the time of contact are made
//   floor       the coordinate (hyper)plane in which those points lie; the coordinate that is zero there is the height:
//               the last one
//   t* = k / n  the time of contact
//   v           displacement of a point in one n-th of the step; so x_t0 = x - k v and x_t1 = x + (n - k) v, with t*
//               rational and all else whole
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "audit/fuzz/random.h"
#include "certify/queries/any_query.h"

namespace noli::audit {

using Whole = std::array<std::int64_t, 3>;
using WholePoints = std::array<Whole, 4>;

Whole operator+(const Whole& a, const Whole& b);
Whole operator-(const Whole& a, const Whole& b);
Whole operator*(std::int64_t s, const Whole& a);
/// The sign of the component of a x b along the third axis.
int floor_cross(const Whole& a, const Whole& b);
bool parallel(const Whole& a, const Whole& b);

struct WholeQuery {
  QueryType type{};
  WholePoints x_t0{};
  WholePoints x_t1{};

  std::size_t size() const { return point_count(type.pair); }
};

/// A time k / n, perhaps outside of the step.
struct StepTime {
  std::int64_t k = 1, n = 2;
};

/// The query whose points are at x at that time and move with v.
WholeQuery passing(const QueryType& type, const WholePoints& x, const WholePoints& v, StepTime when);

/// A whole vector with components in [-size, size] on the first `axes` axes, zero on the others.
Whole random_whole(Random& random, int axes, std::int64_t size);
/// The same, not zero. Precondition: size > 0, axes > 0.
Whole random_direction(Random& random, int axes, std::int64_t size);

/// Adds the same vector to all points at t = 0, and another to all at t = 1.
void carry(WholeQuery& query, const Whole& by_t0, const Whole& by_t1);
/// The same by two vectors drawn one after the other: as arguments of one call they would be drawn in an order that
/// each compiler chooses.
void carry_anywhere(WholeQuery& query, Random& random, int axes, std::int64_t size);

/// Applies to all points a random unimodular shear with entries up to 2, and a permutation and reflection of the axes.
/// Coordinates grow by less than 2^6.
void shear_and_turn(std::span<Whole* const> points, int dimension, Random& random);

/// x times a power of two. Throws std::logic_error when x is too large for a double.
double as_double(std::int64_t x, int exponent);

}  // namespace noli::audit
