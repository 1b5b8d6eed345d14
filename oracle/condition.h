// SPDX-License-Identifier: Apache-2.0
//
// Conditions on the time t: unions of conjunctions of polynomial equations and inequalities, decided in real
// arithmetic.
//
// The truth of a condition can only change at a root of one of its polynomials. So the first time at which a closed
// condition holds is 0 or such a root, and nothing else has to be looked at. (Closed: the set of times at which it
// holds is. Single clauses need not be.)
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
  /// Whether it holds at all times later than t by little enough.
  bool holds_after(const Time& t) const;
  /// Times in [0, 1], sorted or not, among which are all at which it begins or ceases to hold and, if it can hold at 0,
  /// 0.
  std::vector<Time> critical_times() const;
};

/// At least one of the clauses.
using Condition = std::vector<Clause>;

bool holds_at(const Condition& condition, const Time& t);
bool holds_after(const Condition& condition, const Time& t);

/// The least time in [0, 1] at which a closed condition holds.
std::optional<Time> first_time(const Condition& condition);

/// The first of some ascending times at which it holds.
std::optional<Time> first_of(const std::vector<Time>& ascending, const Condition& condition);

}  // namespace noli::oracle
