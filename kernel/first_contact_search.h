// SPDX-License-Identifier: Apache-2.0
//
// The search for the first contact of points that are given in integers.
//
// Notation
//   condition  as in kernel/contact_condition.h, over the time [0, 1] of a step
//   t          a time at which the condition holds, or which is asked about
//
// The integers come from a query (include/noli/time_of_impact.h) or from pieces of world lines (kernel/motion.h).
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <noli/time_of_impact.h>
#include "kernel/arithmetic/algebraic.h"
#include "kernel/contact_condition.h"

namespace noli::condition {

struct At {
  AlgebraicNumber& t;
  int sign(const Polynomial& p) const { return t.sign_of(p); }
};

/// An instant after t, as near as needed.
struct JustAfter {
  AlgebraicNumber& t;

  int sign(const Polynomial& p) const {
    for (Polynomial d = p; !d.is_zero(); d = d.derivative()) {
      if (const int s = t.sign_of(d)) return s;
    }
    return 0;
  }
};

/// Whether the multiplicity of the root t of p is odd.
inline bool changes_sign(const Polynomial& p, AlgebraicNumber& t) {
  bool odd = true;
  for (Polynomial d = p.derivative(); t.sign_of(d) == 0; d = d.derivative()) odd = !odd;
  return odd;
}

inline bool strictly_inside_step(const AlgebraicNumber& t) {
  return t.compare(Dyadic{}) > 0 && t.compare(Dyadic::from_integer(1)) < 0;
}

/// Contacts happen only at roots of f, so none lasts.
template <class Condition>
std::optional<FirstContact> first_among_roots(Condition& condition, const Polynomial& f) {
  for (AlgebraicNumber& t : roots_in_unit_interval(f)) {
    const At time{t};
    if (!condition.holds(time)) continue;
    const bool crossing = strictly_inside_step(t) && condition.transversal(time) && changes_sign(f, t);
    return FirstContact{crossing ? ContactKind::crossing : ContactKind::touching, TimeOfImpact(std::move(t))};
  }
  return std::nullopt;
}

/// The times at which contact can begin if there is no equality, ascending.
template <class Condition>
std::vector<AlgebraicNumber> critical_times(Condition& condition) {
  std::vector<AlgebraicNumber> times = {AlgebraicNumber(Dyadic::from_integer(1))};
  condition.any_critical([&](const Polynomial& p) {
    if (p.degree() < 1) return false;
    std::vector<AlgebraicNumber> roots = roots_in_unit_interval(p);
    std::move(roots.begin(), roots.end(), std::back_inserter(times));
    return false;
  });
  std::sort(times.begin(), times.end());
  return times;
}

template <class Condition>
ContactKind kind_without_equality(Condition& condition, AlgebraicNumber& t) {
  const bool more_to_come = t.compare(Dyadic::from_integer(1)) < 0;
  return more_to_come && condition.holds(JustAfter{t}) ? ContactKind::persistent : ContactKind::touching;
}

/// The set of contact times is closed, and nothing changes between critical times.
template <class Condition>
std::optional<FirstContact> first_among_critical(Condition& condition) {
  AlgebraicNumber start;
  if (condition.holds(At{start})) return FirstContact{kind_without_equality(condition, start), TimeOfImpact(start)};
  for (AlgebraicNumber& t : critical_times(condition)) {
    if (!condition.holds(At{t})) continue;
    const ContactKind kind = kind_without_equality(condition, t);
    return FirstContact{kind, TimeOfImpact(std::move(t))};
  }
  return std::nullopt;
}

template <FeaturePair Pair, class Points>
std::optional<FirstContact> first_contact_of(const Points& points) {
  auto condition = make<Pair>(points);
  const Polynomial* f = condition.equality();
  return f != nullptr ? first_among_roots(condition, *f) : first_among_critical(condition);
}

}  // namespace noli::condition
