// SPDX-License-Identifier: Apache-2.0
//
// A time in [0, 1] that is a root of a polynomial with integer coefficients.
#pragma once

#include <vector>

#include "oracle/polynomial.h"
#include "oracle/sturm.h"

namespace noli::oracle {

/// An algebraic number in [0, 1]. Const members may narrow the interval that isolates it, so one object belongs to one
/// thread.
class Time {
 public:
  /// t = 0.
  Time() : root_{{0, 0}, {0, 0}} {}

  /// The sign of q here.
  int sign_of(const Polynomial& q) const;
  /// The sign of q at all times later than this by little enough; 0 iff q is zero.
  int sign_after(const Polynomial& q) const;
  /// Whether q, which is zero here, changes its sign here. False for the zero polynomial.
  bool changes_sign(const Polynomial& q) const;

  /// -1, 0, 1: how this compares with t.
  int compare(const Dyadic& t) const;
  int compare(double t) const { return compare(exactly(t)); }
  int compare(const Time& other) const;

  /// The largest double that is not greater.
  double lower() const;
  /// Near the number, for a reader's eyes and for tests that need no more.
  double approximation() const;

  /// All roots of p in [0, 1], ascending. Precondition: p is not zero.
  static std::vector<Time> roots_of(const Polynomial& p);

 private:
  Time(Polynomial defining, IsolatedRoot root) : defining_(std::move(defining)), root_(std::move(root)) {}
  bool is_dyadic() const { return oracle::compare(root_.lo, root_.hi) == 0; }
  void halve() const;

  Polynomial defining_;  ///< square-free; not used when the number is dyadic
  mutable IsolatedRoot root_;
};

/// Sorts and keeps one of equals.
void sort_distinct(std::vector<Time>& times);

}  // namespace noli::oracle
