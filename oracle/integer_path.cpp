// SPDX-License-Identifier: Apache-2.0
#include "oracle/integer_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace noli::oracle {

namespace {

/// A double as mantissa 2^exponent, with an odd integer as mantissa, or zero.
struct Parts {
  Integer mantissa = 0;
  long exponent = std::numeric_limits<long>::max();

  explicit Parts(double d) {
    if (d == 0) return;
    const Dyadic value = exactly(d);
    const unsigned long zeros = mpz_scan1(value.numerator.get_mpz_t(), 0);
    mpz_tdiv_q_2exp(mantissa.get_mpz_t(), value.numerator.get_mpz_t(), zeros);
    exponent = static_cast<long>(zeros) - static_cast<long>(value.exponent);
  }
};

/// d / 2^unit. Precondition: the result is an integer.
Integer in_units(double d, long unit) {
  const Parts parts(d);
  Integer result;
  if (sgn(parts.mantissa) != 0) {
    mpz_mul_2exp(result.get_mpz_t(), parts.mantissa.get_mpz_t(), static_cast<unsigned long>(parts.exponent - unit));
  }
  return result;
}

long least_exponent(const Motion& motion, std::size_t axis) {
  long least = std::numeric_limits<long>::max();
  for (std::size_t i = 0; i < point_count(motion.pair); ++i) {
    least = std::min({least, Parts(motion.x_t0[i][axis]).exponent, Parts(motion.x_t1[i][axis]).exponent});
  }
  return least;
}

}  // namespace

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

IntegerPaths integer_paths(const Motion& motion, Unit unit, const std::vector<double>& lengths) {
  const std::size_t axes = static_cast<std::size_t>(motion.dimension);
  std::array<long, 3> units{};
  for (std::size_t axis = 0; axis < axes; ++axis) units[axis] = least_exponent(motion, axis);
  if (unit == Unit::common) {
    long least = *std::min_element(units.begin(), units.begin() + motion.dimension);
    for (const double length : lengths) least = std::min(least, Parts(length).exponent);
    units.fill(least);
  }
  IntegerPaths result;
  for (std::size_t i = 0; i < point_count(motion.pair); ++i) {
    Vector& x = result.x.emplace_back();
    for (std::size_t axis = 0; axis < axes; ++axis) {
      x[axis] =
          Polynomial::linear(in_units(motion.x_t0[i][axis], units[axis]), in_units(motion.x_t1[i][axis], units[axis]));
    }
  }
  for (const double length : lengths) result.also.push_back(in_units(length, units[0]));
  return result;
}

}  // namespace noli::oracle
