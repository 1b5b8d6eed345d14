// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/disguise.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace noli::audit {

namespace {

template <class Function>
void for_each_point(WholeQuery& query, const Function& function) {
  for (std::size_t i = 0; i < query.size(); ++i) {
    function(query.x_t0[i]);
    function(query.x_t1[i]);
  }
}

void shear(WholeQuery& query, Random& random) {
  const auto axes = static_cast<std::uint64_t>(query.type.dimension);
  for (int i = 0; i < 2; ++i) {
    const std::uint64_t to = random.below(axes), from = (to + 1 + random.below(axes - 1)) % axes;
    const std::int64_t by = random.between(-2, 2);
    for_each_point(query, [&](Whole& x) { x[to] += by * x[from]; });
  }
}

void turn(WholeQuery& query, Random& random) {
  const auto axes = static_cast<std::uint64_t>(query.type.dimension);
  for (std::uint64_t axis = 0; axis < axes; ++axis) {
    const std::uint64_t other = axis + random.below(axes - axis);
    const std::int64_t sign = random.one_in(2) ? 1 : -1;
    for_each_point(query, [&](Whole& x) {
      std::swap(x[axis], x[other]);
      x[axis] *= sign;
    });
  }
}

void swap_points(WholeQuery& query, std::size_t i, std::size_t j) {
  std::swap(query.x_t0[i], query.x_t0[j]);
  std::swap(query.x_t1[i], query.x_t1[j]);
}

void rename(WholeQuery& query, Random& random) {
  const std::size_t first = first_size(query.type.pair), size = query.size();
  for (std::size_t i = first; i < size; ++i) swap_points(query, i, i + random.below(size - i));
  if (first == 2 && random.one_in(2)) swap_points(query, 0, 1);
  if (2 * first == size && random.one_in(2)) {
    for (std::size_t i = 0; i < first; ++i) swap_points(query, i, first + i);
  }
}

Point3 scaled(const Whole& x, const AxisExponents& exponents) {
  Point3 result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(x[axis]) > (std::int64_t{1} << 53)) throw std::logic_error("a generated coordinate is no double");
    result[axis] = std::ldexp(static_cast<double>(x[axis]), exponents[axis]);
  }
  return result;
}

}  // namespace

void disguise(WholeQuery& query, Random& random) {
  shear(query, random);
  turn(query, random);
  rename(query, random);
}

Generated finish(Made made, Random& random, const AxisExponents& exponents) {
  disguise(made.query, random);
  AnyQuery query{made.query.type.pair, made.query.type.dimension, {}, {}};
  for (std::size_t i = 0; i < made.query.size(); ++i) {
    query.x_t0[i] = scaled(made.query.x_t0[i], exponents);
    query.x_t1[i] = scaled(made.query.x_t1[i], exponents);
  }
  return {query, made.truth};
}

Generated finish(Made made, Random& random) {
  const int exponent = -static_cast<int>(random.below(41));
  return finish(made, random, {exponent, exponent, exponent});
}

}  // namespace noli::audit
