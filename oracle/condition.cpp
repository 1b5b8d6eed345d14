// SPDX-License-Identifier: Apache-2.0
#include "oracle/condition.h"

#include <algorithm>
#include <iterator>

namespace noli::oracle {

namespace {

/// The nonzero polynomial of least degree; null if all are zero.
const Polynomial* simplest(const std::vector<Polynomial>& polynomials) {
  const Polynomial* best = nullptr;
  for (const Polynomial& p : polynomials) {
    if (!p.is_zero() && (best == nullptr || p.degree() < best->degree())) best = &p;
  }
  return best;
}

}  // namespace

bool Clause::holds_at(const Time& t) const {
  return std::all_of(zero.begin(), zero.end(), [&](const Polynomial& p) { return t.sign_of(p) == 0; }) &&
         std::all_of(positive.begin(), positive.end(), [&](const Polynomial& p) { return t.sign_of(p) > 0; }) &&
         std::all_of(not_negative.begin(), not_negative.end(), [&](const Polynomial& p) { return t.sign_of(p) >= 0; });
}

bool Clause::holds_after(const Time& t) const {
  return std::all_of(zero.begin(), zero.end(), [](const Polynomial& p) { return p.is_zero(); }) &&
         std::all_of(positive.begin(), positive.end(), [&](const Polynomial& p) { return t.sign_after(p) > 0; }) &&
         std::all_of(not_negative.begin(), not_negative.end(),
                     [&](const Polynomial& p) { return t.sign_after(p) >= 0; });
}

std::vector<Time> Clause::critical_times() const {
  if (const Polynomial* equation = simplest(zero)) return Time::roots_of(*equation);
  std::vector<Time> times = {Time()};
  for (const auto* polynomials : {&positive, &not_negative}) {
    for (const Polynomial& p : *polynomials) std::ranges::move(Time::roots_of(p), std::back_inserter(times));
  }
  return times;
}

bool holds_at(const Condition& condition, const Time& t) {
  return std::any_of(condition.begin(), condition.end(), [&](const Clause& clause) { return clause.holds_at(t); });
}

bool holds_after(const Condition& condition, const Time& t) {
  return std::any_of(condition.begin(), condition.end(), [&](const Clause& clause) { return clause.holds_after(t); });
}

std::optional<Time> first_of(const std::vector<Time>& ascending, const Condition& condition) {
  const auto found =
      std::find_if(ascending.begin(), ascending.end(), [&](const Time& t) { return holds_at(condition, t); });
  return found == ascending.end() ? std::nullopt : std::optional(*found);
}

std::optional<Time> first_time(const Condition& condition) {
  std::vector<Time> times;
  for (const Clause& clause : condition) std::ranges::move(clause.critical_times(), std::back_inserter(times));
  sort_distinct(times);
  return first_of(times, condition);
}

}  // namespace noli::oracle
