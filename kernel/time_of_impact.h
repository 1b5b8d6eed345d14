// SPDX-License-Identifier: Apache-2.0
//
// A time of impact: a real algebraic number in [0, 1], the time within the step at which two features first meet.
//
// It is the root of an integer polynomial in a dyadic interval, so nothing about it is rounded: it compares exactly,
// its double below and above are the nearest there are, and it can be refined or written as MPFR number to any
// precision.
//
// What this does not do: no arithmetic. Convert to CGAL's Algebraic_real_1 (kernel/cgal.h) for that.
#pragma once

#include <mpfr.h>

#include <compare>
#include <cstddef>
#include <utility>

#include "kernel/arithmetic/algebraic.h"

namespace noli {

class TimeOfImpact {
 public:
  /// 0.
  TimeOfImpact() = default;
  explicit TimeOfImpact(AlgebraicNumber value) : value_(std::move(value)) {}
  /// Exact. Throws std::domain_error unless 0 <= t <= 1.
  static TimeOfImpact from_double(double t);
  /// num / den. Throws std::domain_error unless 0 <= num / den <= 1 and den is not 0.
  static TimeOfImpact from_rational(Integer num, Integer den);

  /// The largest double <= this time.
  double lower() const { return value_.floor(); }
  /// The smallest double >= this time.
  double upper() const;

  /// A dyadic interval of width at most 2^-bits that contains this time; both ends are it if the time is known to be
  /// dyadic. Otherwise the polynomial is not zero at the ends and has just this root between them.
  std::pair<Dyadic, Dyadic> enclosure(std::size_t bits) const;
  /// A square-free primitive polynomial with positive leading coefficient of which this time is a root.
  Polynomial polynomial() const { return value_.polynomial().primitive(); }
  const AlgebraicNumber& algebraic() const { return value_; }

  /// Sets `result` to this time, correctly rounded to the precision that `result` has. Returns MPFR's ternary value:
  /// the sign of (result - time), 0 if exact.
  int to_mpfr(mpfr_ptr result, mpfr_rnd_t rounding) const;

  friend std::strong_ordering operator<=>(const TimeOfImpact& a, const TimeOfImpact& b) {
    return a.value_ <=> b.value_;
  }
  friend bool operator==(const TimeOfImpact& a, const TimeOfImpact& b) { return (a <=> b) == 0; }

 private:
  AlgebraicNumber value_;
};

}  // namespace noli
