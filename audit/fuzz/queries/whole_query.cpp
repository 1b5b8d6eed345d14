// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/whole_query.h"

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace noli::audit {

Whole operator+(const Whole& a, const Whole& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Whole operator-(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Whole operator*(std::int64_t s, const Whole& a) { return {s * a[0], s * a[1], s * a[2]}; }

namespace {

/// a b - c d compared with 0, without overflow.
int sign_of_difference(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
  __extension__ using Wide = __int128;
  const Wide left = static_cast<Wide>(a) * b, right = static_cast<Wide>(c) * d;
  return left < right ? -1 : left > right ? 1 : 0;
}

}  // namespace

int floor_cross(const Whole& a, const Whole& b) { return sign_of_difference(a[0], b[1], a[1], b[0]); }

bool parallel(const Whole& a, const Whole& b) {
  return sign_of_difference(a[0], b[1], a[1], b[0]) == 0 && sign_of_difference(a[1], b[2], a[2], b[1]) == 0 &&
         sign_of_difference(a[2], b[0], a[0], b[2]) == 0;
}

WholeQuery passing(const QueryType& type, const WholePoints& x, const WholePoints& v, StepTime when) {
  WholeQuery query{type, {}, {}};
  for (std::size_t i = 0; i < query.size(); ++i) {
    query.x_t0[i] = x[i] - when.k * v[i];
    query.x_t1[i] = x[i] + (when.n - when.k) * v[i];
  }
  return query;
}

Whole random_whole(Random& random, int axes, std::int64_t size) {
  Whole result{};
  for (int axis = 0; axis < axes; ++axis) result[static_cast<std::size_t>(axis)] = random.between(-size, size);
  return result;
}

Whole random_direction(Random& random, int axes, std::int64_t size) {
  Whole result{};
  while (result == Whole{}) result = random_whole(random, axes, size);
  return result;
}

void carry(WholeQuery& query, const Whole& by_t0, const Whole& by_t1) {
  for (std::size_t i = 0; i < query.size(); ++i) {
    query.x_t0[i] = query.x_t0[i] + by_t0;
    query.x_t1[i] = query.x_t1[i] + by_t1;
  }
}

void carry_anywhere(WholeQuery& query, Random& random, int axes, std::int64_t size) {
  const Whole by_t0 = random_whole(random, axes, size);
  carry(query, by_t0, random_whole(random, axes, size));
}

void shear_and_turn(std::span<Whole* const> points, int dimension, Random& random) {
  const auto axes = static_cast<std::uint64_t>(dimension);
  for (int i = 0; i < 2; ++i) {
    const std::uint64_t to = random.below(axes), from = (to + 1 + random.below(axes - 1)) % axes;
    const std::int64_t by = random.between(-2, 2);
    for (Whole* const x : points) (*x)[to] += by * (*x)[from];
  }
  for (std::uint64_t axis = 0; axis < axes; ++axis) {
    const std::uint64_t other = axis + random.below(axes - axis);
    const std::int64_t sign = random.one_in(2) ? 1 : -1;
    for (Whole* const x : points) {
      std::swap((*x)[axis], (*x)[other]);
      (*x)[axis] *= sign;
    }
  }
}

double as_double(std::int64_t x, int exponent) {
  if (std::abs(x) > (std::int64_t{1} << 53)) throw std::logic_error("a generated coordinate is not a double");
  return std::ldexp(static_cast<double>(x), exponent);
}

}  // namespace noli::audit
