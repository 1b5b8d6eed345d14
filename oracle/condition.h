// SPDX-License-Identifier: Apache-2.0
//
// Decides conditions on the time t: unions of conjunctions of polynomial equations and inequalities, in exact real
// arithmetic.
//
// The truth of a condition can only change at a root of one of its polynomials. So the first time at which a closed
// condition holds is 0 or such a root, and these are the only candidates. A condition is closed if the set of times at
// which it holds is closed; single clauses need not be.
#pragma once

#include <optional>
#include <vector>

#include "oracle/polynomial.h"
#include "oracle/time.h"

namespace noli::oracle {

/// p = 0 for all p of `zero`, p > 0 for all of `positive`, p >= 0 for all of `not_negative`.
struct Clause {
  std::vector<Polynomial> zero, positive, not_negative;

  bool holds_at(const Time& t) const;
  /// Whether it holds on some interval ]t, t + e[.
  bool holds_after(const Time& t) const;
  /// Times in [0, 1], in any order, that include all times at which it begins or ceases to hold, and 0 if it can hold
  /// there.
  std::vector<Time> critical_times() const;
};

/// Holds if at least one of the clauses holds.
using Condition = std::vector<Clause>;

bool holds_at(const Condition& condition, const Time& t);
bool holds_after(const Condition& condition, const Time& t);

/// The least time in [0, 1] at which a closed condition holds.
std::optional<Time> first_time(const Condition& condition);

/// The first of the ascending times at which the condition holds.
std::optional<Time> first_of(const std::vector<Time>& ascending, const Condition& condition);

}  // namespace noli::oracle
