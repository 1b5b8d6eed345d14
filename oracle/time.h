// SPDX-License-Identifier: Apache-2.0
//
// Represents a time in [0, 1] that is a root of a polynomial with integer coefficients.
#pragma once

#include <vector>

#include "oracle/polynomial.h"
#include "oracle/sturm.h"

namespace noli::oracle {

/// An algebraic number in [0, 1]. Not thread-safe: const members may narrow the isolating interval.
class Time {
 public:
  /// t = 0.
  Time() : root_{{0, 0}, {0, 0}} {}

  /// The sign of q here.
  int sign_of(const Polynomial& q) const;
  /// The sign of q just after this time; 0 iff q is the zero polynomial.
  int sign_after(const Polynomial& q) const;
  /// Whether q changes its sign here. False for the zero polynomial.
  bool changes_sign(const Polynomial& q) const;

  /// -1, 0, 1: earlier than t, equal, later.
  int compare(const Dyadic& t) const;
  int compare(double t) const { return compare(exactly(t)); }
  int compare(const Time& other) const;

  /// The largest double that is not greater than this time.
  double lower() const;
  /// An approximation without an error bound, for display and for tests.
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

/// Sorts and removes duplicates.
void sort_distinct(std::vector<Time>& times);

}  // namespace noli::oracle
