// SPDX-License-Identifier: Apache-2.0
//
// Dyadic numbers m / 2^e, exact: doubles, and the ends of isolating intervals.
#pragma once

#include <compare>
#include <cstddef>

#include "kernel/arithmetic/integer.h"

namespace noli {

struct Dyadic {
  Integer m;
  std::size_t e = 0;

  /// Exact. Precondition: x is finite.
  static Dyadic from_double(double x);
  static Dyadic from_integer(long value) { return {Integer(value), 0}; }

  int sign() const { return m.sign(); }
  /// The numerator over 2^bits. Precondition: bits >= e.
  Integer scaled(std::size_t bits) const { return m << (bits - e); }
  /// m odd or e zero.
  Dyadic reduced() const;

  friend std::strong_ordering operator<=>(const Dyadic& a, const Dyadic& b);
  friend bool operator==(const Dyadic& a, const Dyadic& b) { return (a <=> b) == 0; }
};

Dyadic operator+(const Dyadic& a, const Dyadic& b);
Dyadic operator-(const Dyadic& a, const Dyadic& b);
Dyadic operator*(const Dyadic& a, const Dyadic& b);
/// x 2^k, reduced.
Dyadic ldexp(Dyadic x, int k);
Dyadic middle(const Dyadic& a, const Dyadic& b);

/// The largest double <= x, and the smallest double >= x; beyond the range of double +-DBL_MAX or an infinity.
double floor_to_double(const Dyadic& x);
double ceil_to_double(const Dyadic& x);

}  // namespace noli
