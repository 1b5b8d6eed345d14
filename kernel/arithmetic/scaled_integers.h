// SPDX-License-Identifier: Apache-2.0
//
// The coordinates of a query as integers: all multiplied by one power of two. Exact; contact and its time do not
// change.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "kernel/arithmetic/wide.h"
#include "kernel/formula.h"
#include "kernel/query.h"

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
  /// Bits of the largest integer, once all are multiplied by 2^-low.
  int bits() const { return high > low ? high - low : 0; }
};

template <FeaturePair Pair, int Dim>
ExponentRange exponent_range(const Query<Pair, Dim>& q) {
  ExponentRange range;
  for (const auto* points : {&q.x_t0, &q.x_t1}) {
    for (const auto& point : *points) {
      for (const double x : point) range.add(x);
    }
  }
  return range;
}

/// The moving points of a query, times 2^-range.low. Precondition: range.bits() < 64 C.
template <std::size_t C, FeaturePair Pair, int Dim>
std::array<formula::Moving<Wide<C>, Dim>, point_count(Pair)> scaled(const Query<Pair, Dim>& q,
                                                                    const ExponentRange& range) {
  const auto integer = [&range](double x) {
    if (x == 0) return Wide<C>();
    const OddBinary parts(x);
    return Wide<C>::shifted(parts.mantissa, static_cast<unsigned>(parts.exponent - range.low));
  };
  std::array<formula::Moving<Wide<C>, Dim>, point_count(Pair)> result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      result[i].at_t0[axis] = integer(q.x_t0[i][axis]);
      result[i].at_t1[axis] = integer(q.x_t1[i][axis]);
    }
  }
  return result;
}

}  // namespace noli::exact
