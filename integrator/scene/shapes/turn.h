// SPDX-License-Identifier: Apache-2.0
//
// Cosine and sine with the same bits on every machine: + - * / of doubles in a fixed order, without functions of the C
// library.
//
// Method: reduce the angle to [0, pi/4] exactly, by integers or multiples of 45 degrees. Evaluate the Taylor series to
// x^17 and x^18, whose remainder is below 1e-16, by Horner's rule. Then apply the symmetries of the octants. So points
// at equal angles on either side of an axis or a diagonal have coordinates that are equal bit for bit, up to sign and
// order. Errors are below 1e-15; results are not correctly rounded.
#pragma once

#include <cstdint>

namespace noli::integrator {

struct CosSin {
  double cos = 1, sin = 0;
  friend bool operator==(const CosSin&, const CosSin&) = default;
};

/// Cosine and sine of k/n of a whole turn. Precondition: 0 < n < 2^60.
CosSin part_of_turn(std::uint64_t k, std::uint64_t n);

/// Precondition: finite, at most 1e15 in magnitude.
CosSin of_degrees(double degrees);

}  // namespace noli::integrator
