// SPDX-License-Identifier: Apache-2.0
//
// Cosine and sine with the same bits everywhere: + - * / of doubles in a fixed order, no functions of the C library.
//
// Method: the angle is brought into [0, pi/4] exactly, by integers or by multiples of 45 degrees; there the Taylor
// series to x^17 and x^18, whose rest is below 1e-16, by Horner's rule; then the symmetries of the octants. So points
// at equal angles on either side of an axis or a diagonal have coordinates that are equal bit for bit, up to sign and
// order. Errors are below 1e-15.
//
// What this does not do: round correctly.
#pragma once

#include <cstdint>

namespace noli::integrator {

struct CosSin {
  double cos = 1, sin = 0;
  friend bool operator==(const CosSin&, const CosSin&) = default;
};

/// Of k/n of a whole turn. Precondition: 0 < n < 2^60.
CosSin part_of_turn(std::uint64_t k, std::uint64_t n);

/// Precondition: finite, at most 1e15 in size.
CosSin of_degrees(double degrees);

}  // namespace noli::integrator
