// SPDX-License-Identifier: Apache-2.0
//
// Converts the points of a motion to polynomials in t with integer coefficients: the doubles times a power of two.
#pragma once

#include <array>
#include <vector>

#include "oracle/motion.h"
#include "oracle/polynomial.h"

namespace noli::oracle {

/// A vector whose components are polynomials in t.
using Vector = std::array<Polynomial, 3>;

Vector operator-(const Vector& a, const Vector& b);
Polynomial dot(const Vector& a, const Vector& b);
Vector cross(const Vector& a, const Vector& b);

/// For questions about contact alone, each axis may have its own power of two, because scaling an axis keeps contacts.
enum class Unit { per_axis, common };

struct IntegerPaths {
  std::vector<Vector> x;      ///< the points; third component zero in 2D
  std::vector<Integer> also;  ///< `lengths` in the same unit. Empty for Unit::per_axis
};

/// `lengths`: further numbers to convert. Precondition: empty for Unit::per_axis.
IntegerPaths integer_paths(const Motion& motion, Unit unit, const std::vector<double>& lengths = {});

}  // namespace noli::oracle
