// SPDX-License-Identifier: Apache-2.0
//
// Real algebraic numbers in [0, 1]: roots of integer polynomials, compared and evaluated exactly.
//
// Notation
//   p                 a square-free integer polynomial
//   [low, high]       has dyadic ends; p has exactly one root in it, which is the number. Either p is not zero at low
//                     and high, which lie on different sides of the root; or low = high, and p is linear
//
// Method: roots are separated by Descartes' rule on Bernstein coefficients with bisection (Collins and Akritas 1976;
// Lane and Riesenfeld 1981), refined by quadratic interval refinement (Abbott 2014). Whether a polynomial is zero at a
// number is decided by gcd, all other signs by refinement; double precision only proposes, or answers where its error
// is bounded.
//
// There is no arithmetic on these numbers; noli/cgal.h has it.
#pragma once

#include <compare>
#include <cstddef>
#include <memory>
#include <vector>

#include "kernel/arithmetic/dyadic.h"
#include "kernel/arithmetic/polynomial.h"

namespace noli {

class AlgebraicNumber {
 public:
  /// 0.
  AlgebraicNumber() : AlgebraicNumber(Dyadic{}) {}
  /// Precondition: in [0, 1].
  explicit AlgebraicNumber(const Dyadic& x);
  /// num / den. Precondition: 0 <= num <= den, den > 0.
  static AlgebraicNumber rational(const Integer& num, const Integer& den);
  /// The root of p in [low, high]. Preconditions: those of the notation above.
  AlgebraicNumber(std::shared_ptr<const Polynomial> p, Dyadic low, Dyadic high);

  const Polynomial& polynomial() const { return *p_; }
  const Dyadic& low() const { return low_; }
  const Dyadic& high() const { return high_; }
  bool is_rational() const { return p_->degree() == 1; }
  bool is_dyadic() const { return low_ == high_; }

  /// high - low < 2^-width_bits(). Precondition: not dyadic.
  std::size_t width_bits() const;
  /// Makes high - low < 2^-bits.
  void refine(std::size_t bits);
  /// Shrinks the interval to about 2^-45 if double precision finds the root; otherwise does nothing.
  void polish(double proposal);

  /// The sign of q at this number. The first overload keeps the interval that it refined.
  int sign_of(const Polynomial& q);
  int sign_of(const Polynomial& q) const { return AlgebraicNumber(*this).sign_of(q); }
  /// The sign of (this number - x).
  int compare(const Dyadic& x) const;
  /// Replaces the interval by its part on the number's side of x; by x itself if x is the number.
  void cut_at(const Dyadic& x);
  /// The largest double that is not greater than this number.
  double floor() const;

  friend std::strong_ordering operator<=>(const AlgebraicNumber& a, const AlgebraicNumber& b);
  friend bool operator==(const AlgebraicNumber& a, const AlgebraicNumber& b) { return (a <=> b) == 0; }

 private:
  void become(Dyadic x);
  void set_interval(Dyadic low, Dyadic high);
  /// cut_at, given the sign of (number - x).
  void keep_side(const Dyadic& x, int side);
  /// One step of refinement. Raises or lowers `log_pieces`, the binary logarithm of the number of pieces tried.
  void refine_quadratically(std::size_t& log_pieces);
  bool approximate_sign(const Polynomial& q, int& sign) const;
  int sign_by_refinement(const Polynomial& q);

  std::shared_ptr<const Polynomial> p_;
  Dyadic low_, high_;
  int sign_high_ = 0;  ///< of p at high; 0 iff low = high
  double about_ = 0;   ///< middle of the interval, rounded
  double reach_ = 0;   ///< the interval lies within about_ +- reach_
};

/// The distinct roots of p in [0, 1], ascending. Precondition: p is not zero.
std::vector<AlgebraicNumber> roots_in_unit_interval(const Polynomial& p);

}  // namespace noli
