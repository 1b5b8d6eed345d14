// SPDX-License-Identifier: Apache-2.0
//
// Univariate polynomials with integer coefficients, of any (low) degree.
//
// Notation
//   p = c[0] + c[1] t + ... + c[n] t^n, c[n] != 0; the zero polynomial has degree -1
//   content           the greatest common divisor of the coefficients; a polynomial of content 1 is primitive
//   form              the homogeneous form of kernel/formula.h on s + t = 1
//
// Everything is quadratic in n, so it is not meant for high degrees. Roots are in kernel/arithmetic/algebraic.h.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "kernel/arithmetic/dyadic.h"
#include "kernel/arithmetic/integer.h"

namespace noli {

class Polynomial {
 public:
  Polynomial() = default;
  /// c[i] is the coefficient of t^i; leading zeros are dropped.
  explicit Polynomial(std::vector<Integer> coefficients) : c_(std::move(coefficients)) { trim(); }

  int degree() const { return static_cast<int>(c_.size()) - 1; }
  bool is_zero() const { return c_.empty(); }
  const Integer& operator[](std::size_t i) const { return c_[i]; }
  /// Precondition: not zero.
  const Integer& leading() const { return c_.back(); }

  /// p(x) 2^(e n) for x = m / 2^e. 0 for the zero polynomial.
  Integer scaled_value(const Integer& m, std::size_t e) const;
  int sign_at(const Dyadic& x) const { return scaled_value(x.m, x.e).sign(); }
  /// The sign at num / den. Precondition: den > 0.
  int sign_at_rational(const Integer& num, const Integer& den) const;

  Polynomial derivative() const;
  Integer content() const;
  /// Divided by the content and by the sign of the leading coefficient.
  Polynomial primitive() const;
  /// Divided by the largest power of two that divides all coefficients; cheap.
  Polynomial without_power_of_two() const;
  /// The sum of |c[i]|.
  Integer coefficient_sum() const;

  Polynomial& operator+=(const Polynomial& b);
  Polynomial& operator-=(const Polynomial& b);
  friend Polynomial operator+(Polynomial a, const Polynomial& b) { return a += b; }
  friend Polynomial operator-(Polynomial a, const Polynomial& b) { return a -= b; }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  friend Polynomial quotient(Polynomial a, const Polynomial& b);
  friend bool operator==(const Polynomial&, const Polynomial&) = default;

 private:
  void trim() {
    while (!c_.empty() && c_.back().is_zero()) c_.pop_back();
  }
  std::vector<Integer> c_;
};

/// c[0] s^n + c[1] s^(n-1) t + ... + c[n] t^n at s = 1 - t, as a polynomial in t.
Polynomial from_form(std::vector<Integer> form);

/// The number of sign changes in a sequence; zeros are skipped.
int sign_changes(const std::vector<Integer>& numbers);

/// True only if a and b have no common root, real or complex; false means "not known". Works modulo a prime, which is
/// much cheaper than gcd. Precondition: neither is zero.
bool surely_coprime(const Polynomial& a, const Polynomial& b);

/// Primitive greatest common divisor, by the primitive remainder sequence; that of 0 and 0 is 0.
Polynomial gcd(const Polynomial& a, const Polynomial& b);

/// a / b. Preconditions: b is not zero, and the quotient has integer coefficients. By Gauss's lemma it has if b is
/// primitive and divides a over the rationals.
Polynomial quotient(Polynomial a, const Polynomial& b);

/// A polynomial with the same roots, all simple. If they were simple already, it differs from p by a constant factor.
/// Precondition: p is not zero.
Polynomial square_free_part(const Polynomial& p);

}  // namespace noli
