// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/disguise.h"

#include <utility>
#include <vector>

namespace noli::audit {

namespace {

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

void disguise(WholeQuery& query, Random& random) {
  std::vector<Whole*> points;
  for (std::size_t i = 0; i < query.size(); ++i) points.insert(points.end(), {&query.x_t0[i], &query.x_t1[i]});
  shear_and_turn(points, query.type.dimension, random);
  rename(query, random);
}

}  // namespace

Generated finish(Made made, Random& random, const AxisExponents& exponents) {
  disguise(made.query, random);
  AnyQuery query{made.query.type.pair, made.query.type.dimension, {}, {}};
  for (std::size_t i = 0; i < made.query.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      query.x_t0[i][axis] = as_double(made.query.x_t0[i][axis], exponents[axis]);
      query.x_t1[i][axis] = as_double(made.query.x_t1[i][axis], exponents[axis]);
    }
  }
  return {query, made.truth};
}

Generated finish(Made made, Random& random) {
  const int exponent = -static_cast<int>(random.below(41));
  return finish(made, random, {exponent, exponent, exponent});
}

}  // namespace noli::audit
