// SPDX-License-Identifier: Apache-2.0
//
// Doubles as integers of any size: all times one power of two, chosen so that nothing is lost (scaled_integers.h has
// the same in fixed width).
//
// What this does not do: it rounds nothing, so coordinates of 1e300 next to some of 1e-300 make integers of 2000 bits.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/arithmetic/integer.h"
#include "kernel/arithmetic/scaled_integers.h"

namespace noli {

/// x / 2^range.low. Precondition: the range covers x.
inline Integer integer_coordinate(double x, const exact::ExponentRange& range) {
  if (x == 0) return {};
  const exact::OddBinary parts(x);
  return Integer(parts.mantissa) << static_cast<std::size_t>(parts.exponent - range.low);
}

/// The moving points of a query, times 2^-range.low.
template <FeaturePair Pair, int Dim>
auto integer_points(const Query<Pair, Dim>& query, const exact::ExponentRange& range) {
  std::array<formula::Moving<Integer, Dim>, point_count(Pair)> x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      x[i].at_t0[axis] = integer_coordinate(query.x_t0[i][axis], range);
      x[i].at_t1[axis] = integer_coordinate(query.x_t1[i][axis], range);
    }
  }
  return x;
}

}  // namespace noli
