// SPDX-License-Identifier: Apache-2.0
//
// The exact time at which a contact begins in a run, as an algebraic number that compares across pieces of the run.
//
// Notation
//   window   [T0, T1], T0 < T1 doubles; moments compare only within the same window
//   sigma    (t - T0) / 2^e, with e such that T1 - T0 <= 2^e: in [0, 1] for t in the window
//   s        the time within a piece [begin, end] of the window, as in kernel/motion.h
//
// sigma is a dyadic affine function of s. So a root of p(s) is a root of an integer polynomial in sigma, and isolating
// intervals stay isolating.
#pragma once

#include <compare>
#include <utility>

#include <noli/time_of_impact.h>
#include "kernel/arithmetic/algebraic.h"

namespace noli {

/// The time to which moments are relative. Preconditions: finite, begin < end.
struct Window {
  double begin, end;
};

class Moment {
 public:
  /// The time s of the piece [begin, end]. Precondition: the piece is within the window, begin < end.
  Moment(const Window& window, double begin, double end, const TimeOfImpact& s);

  /// The largest double <= this time.
  double lower() const;
  /// The smallest double >= this time.
  double upper() const;
  /// The sign of (this time - t). Precondition: t is finite.
  int compare(double t) const;

  /// Precondition of both: the same window.
  friend std::strong_ordering operator<=>(const Moment& a, const Moment& b) { return a.sigma_ <=> b.sigma_; }
  friend bool operator==(const Moment& a, const Moment& b) { return (a <=> b) == 0; }

 private:
  std::pair<double, double> neighbours() const;

  Dyadic origin_;
  int exponent_;
  AlgebraicNumber sigma_;
};

}  // namespace noli
