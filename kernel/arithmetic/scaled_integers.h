// SPDX-License-Identifier: Apache-2.0
//
// The coordinates of a query as integers, of fixed or any width: all multiplied by one power of two. Exact; contact and
// its time do not change.
//
// Nothing is rounded, so coordinates of 1e300 next to 1e-300 make integers of 2000 bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <noli/query.h>
#include "kernel/arithmetic/integer.h"
#include "kernel/arithmetic/wide.h"
#include "kernel/formula.h"

namespace noli::exact {

/// x = mantissa * 2^exponent with an odd mantissa, or 0.
struct OddBinary {
  std::int64_t mantissa = 0;
  int exponent = 0;

  explicit OddBinary(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int biased = static_cast<int>((bits >> 52) & 0x7ff);
    std::uint64_t magnitude = bits & 0xfffffffffffff;
    if (biased != 0) magnitude |= std::uint64_t{1} << 52;
    if (magnitude == 0) return;
    const int zeros = std::countr_zero(magnitude);
    mantissa = static_cast<std::int64_t>(magnitude >> zeros);
    if ((bits >> 63) != 0) mantissa = -mantissa;
    exponent = std::max(biased, 1) - 1075 + zeros;
  }

  /// |x| < 2^top.
  int top() const {
    return exponent + static_cast<int>(std::bit_width(static_cast<std::uint64_t>(mantissa < 0 ? -mantissa : mantissa)));
  }
};

/// The exponents in use: every coordinate is a multiple of 2^low and below 2^high in magnitude.
struct ExponentRange {
  int low = std::numeric_limits<int>::max();
  int high = std::numeric_limits<int>::min();

  void add(double x) {
    if (x == 0) return;
    const OddBinary parts(x);
    low = std::min(low, parts.exponent);
    high = std::max(high, parts.top());
  }
  template <std::size_t N>
  void add(const std::array<double, N>& x) {
    for (const double c : x) add(c);
  }
  /// Bits of the largest integer after all are multiplied by 2^-low.
  int bits() const { return high > low ? high - low : 0; }
};

template <FeaturePair Pair, int Dim>
ExponentRange exponent_range(const Query<Pair, Dim>& q) {
  ExponentRange range;
  for (const auto* points : {&q.x_t0, &q.x_t1}) {
    for (const auto& point : *points) range.add(point);
  }
  return range;
}

/// x / 2^range.low, as an Integer or a Wide. Preconditions: the range covers x; range.bits() < 64 C for a Wide<C>.
template <class T>
T coordinate(double x, const ExponentRange& range) {
  if (x == 0) return T();
  const OddBinary parts(x);
  const int shift = parts.exponent - range.low;
  if constexpr (std::is_same_v<T, Integer>) {
    return Integer(parts.mantissa) << static_cast<std::size_t>(shift);
  } else {
    return T::shifted(parts.mantissa, static_cast<unsigned>(shift));
  }
}

/// The moving points of a query, times 2^-range.low.
template <class T, FeaturePair Pair, int Dim>
auto scaled(const Query<Pair, Dim>& q, const ExponentRange& range) {
  std::array<formula::Moving<T, Dim>, point_count(Pair)> result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      result[i].at_t0[axis] = coordinate<T>(q.x_t0[i][axis], range);
      result[i].at_t1[axis] = coordinate<T>(q.x_t1[i][axis], range);
    }
  }
  return result;
}

}  // namespace noli::exact
