// SPDX-License-Identifier: Apache-2.0
//
// Generates random queries in which coincidences of every kind are common.
#pragma once

#include <cmath>
#include <random>

#include <noli/query.h>

namespace noli::test {

/// How the coordinates of a query are drawn.
enum class Coordinates {
  tiny_grid,    ///< integers from -2 to 2: nearly everything coincides
  small_grid,   ///< integers from -9 to 9
  floats,       ///< 24 bits in [-1, 1)
  doubles,      ///< 53 bits in [-1, 1)
  nudged_grid,  ///< integers from -2 to 2, some moved by a few ulps
  far_apart     ///< integers times powers of two from 2^-400 to 2^400
};

constexpr std::array all_coordinates = {Coordinates::tiny_grid, Coordinates::small_grid,  Coordinates::floats,
                                        Coordinates::doubles,   Coordinates::nudged_grid, Coordinates::far_apart};

inline double integer_between(std::mt19937_64& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}

inline double coordinate(Coordinates how, std::mt19937_64& random) {
  switch (how) {
    case Coordinates::tiny_grid: return integer_between(random, -2, 2);
    case Coordinates::small_grid: return integer_between(random, -9, 9);
    case Coordinates::floats: return integer_between(random, -(1 << 23), (1 << 23) - 1) * 0x1p-23;
    case Coordinates::doubles: return static_cast<double>(static_cast<std::int64_t>(random()) >> 11) * 0x1p-52;
    case Coordinates::nudged_grid: {
      const double x = integer_between(random, -2, 2);
      return random() % 4 == 0 ? x + integer_between(random, -2, 2) * 0x1p-52 : x;
    }
    case Coordinates::far_apart:
      return std::ldexp(integer_between(random, -2, 2), static_cast<int>(integer_between(random, -400, 400)));
  }
  return 0;
}

/// A random query; sometimes a point rests, or coincides with another one.
template <FeaturePair Pair, int Dim>
Query<Pair, Dim> any_query(Coordinates how, std::mt19937_64& random) {
  Query<Pair, Dim> q;
  for (auto* points : {&q.x_t0, &q.x_t1}) {
    for (auto& point : *points) {
      for (double& x : point) x = coordinate(how, random);
    }
  }
  for (std::size_t i = 0; i < q.size; ++i) {
    const std::uint64_t choice = random() % 16;
    if (choice < 3) q.x_t1[i] = q.x_t0[i];
    if (choice == 3) q.x_t0[i] = q.x_t0[random() % q.size];
    if (choice == 4) q.x_t1[i] = q.x_t1[random() % q.size];
  }
  return q;
}

}  // namespace noli::test
