// SPDX-License-Identifier: Apache-2.0
//
// Implements exact polynomials in one variable with integer coefficients of any size.
#pragma once

#include <gmpxx.h>

#include <cstddef>
#include <vector>

namespace noli::oracle {

using Integer = mpz_class;

/// The number numerator / 2^exponent.
struct Dyadic {
  Integer numerator;
  unsigned long exponent = 0;
};

/// -1 if a < b, 0 if a = b, 1 if a > b.
int compare(const Dyadic& a, const Dyadic& b);

/// (a + b) / 2.
Dyadic middle(const Dyadic& a, const Dyadic& b);

/// The exact value of d. Precondition: d is finite.
Dyadic exactly(double d);

/// c[0] + c[1] t + ... The zero polynomial has no coefficients; the leading coefficient of any other is nonzero.
class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(std::vector<Integer> coefficients);

  /// The linear polynomial that is at_t0 at t = 0 and at_t1 at t = 1.
  static Polynomial linear(const Integer& at_t0, const Integer& at_t1);
  static Polynomial constant(const Integer& value);

  bool is_zero() const { return c_.empty(); }
  /// -1 for the zero polynomial.
  int degree() const { return static_cast<int>(c_.size()) - 1; }
  const Integer& operator[](std::size_t i) const { return c_[i]; }
  const Integer& leading() const { return c_.back(); }

  Polynomial derivative() const;
  /// This polynomial divided by the positive greatest common divisor of its coefficients.
  Polynomial primitive() const;

  int sign_at(const Dyadic& t) const;

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  friend bool operator==(const Polynomial&, const Polynomial&) = default;

 private:
  void trim();
  std::vector<Integer> c_;
};

/// The remainder of a by b times some positive number. Precondition: b is not zero.
Polynomial remainder(const Polynomial& a, const Polynomial& b);

/// a / b times some positive number. Precondition: b is not zero and divides a over the rationals.
Polynomial exact_quotient(const Polynomial& a, const Polynomial& b);

/// The sign of p on the whole closed interval [lo, hi], or 0 if a bound from the Taylor coefficients at lo does not
/// decide it.
int sign_throughout(const Polynomial& p, const Dyadic& lo, const Dyadic& hi);

}  // namespace noli::oracle
