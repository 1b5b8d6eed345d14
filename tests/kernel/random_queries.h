// SPDX-License-Identifier: Apache-2.0
//
// Generates random queries with frequent degenerate features, coplanar motion, shared coordinates and contacts of all
// kinds.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <noli/query.h>
#include "tests/kernel/random_numbers.h"

namespace noli::test {

/// How coordinates are drawn.
enum class Spread { tiny_integers, small_integers, integers, nearly_integers, doubles, any_magnitude };
constexpr std::array all_spreads = {Spread::tiny_integers,   Spread::small_integers, Spread::integers,
                                    Spread::nearly_integers, Spread::doubles,        Spread::any_magnitude};

inline double random_coordinate(Random& random, Spread how) {
  switch (how) {
    case Spread::tiny_integers: return random.around_zero(1);
    case Spread::small_integers: return random.around_zero(2);
    case Spread::integers: return random.around_zero(20);
    case Spread::nearly_integers: return random.around_zero(4) + random.around_zero(1) * 0x1p-50;
    case Spread::doubles: return random.unit() - 0.5;
    case Spread::any_magnitude: return random.around_zero(2) * std::ldexp(1.0, random.around_zero(1) * 1000);
  }
  return 0;
}

template <class Query>
Query random_query(Random& random, Spread how) {
  Query q;
  constexpr auto size = static_cast<int>(Query::size);
  for (auto* points : {&q.x_t0, &q.x_t1}) {
    for (auto& p : *points) {
      for (double& x : p) x = random_coordinate(random, how);
    }
  }
  // Some points rest, coincide, or stay in a coordinate plane.
  if (random.below(4) == 0) {
    for (std::size_t i = 1; i < Query::size; ++i) q.x_t1[i] = q.x_t0[i];
  }
  if (random.below(8) == 0) {
    const auto i = static_cast<std::size_t>(random.below(size)), j = static_cast<std::size_t>(random.below(size));
    q.x_t0[i] = q.x_t0[j];
    if (random.below(2) == 0) q.x_t1[i] = q.x_t1[j];
  }
  for (int flat = random.below(4) - 1; flat > 0; --flat) {
    const auto axis = static_cast<std::size_t>(random.below(Query::dimension));
    for (auto* points : {&q.x_t0, &q.x_t1}) {
      for (auto& p : *points) p[axis] = flat;
    }
  }
  return q;
}

template <class Query>
Query random_query(Random& random) {
  return random_query<Query>(random, all_spreads[static_cast<std::size_t>(random.below(all_spreads.size()))]);
}

}  // namespace noli::test
