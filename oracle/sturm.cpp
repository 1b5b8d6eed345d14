// SPDX-License-Identifier: Apache-2.0
#include "oracle/sturm.h"

#include <utility>

namespace noli::oracle {

namespace {

Polynomial negative(const Polynomial& p) { return Polynomial() - p; }

/// Bisects (lo, hi] until each piece isolates one root; `at_lo`, `at_hi` are V there.
struct Isolation {
  const Polynomial& p;
  std::vector<Polynomial> sequence;
  std::vector<IsolatedRoot> found;

  /// Records the only root of (lo, hi]. Returns false without recording it if lo is a root too and hi is not.
  bool settle(const Dyadic& lo, const Dyadic& hi) {
    if (p.sign_at(hi) == 0) {
      found.push_back({hi, hi});
      return true;
    }
    if (p.sign_at(lo) == 0) return false;
    found.push_back({lo, hi});
    return true;
  }

  void run(const Dyadic& lo, int at_lo, const Dyadic& hi, int at_hi) {
    const int count = at_lo - at_hi;
    if (count == 0 || (count == 1 && settle(lo, hi))) return;
    const Dyadic mid = middle(lo, hi);
    const int at_mid = sign_changes(sequence, mid);
    run(lo, at_lo, mid, at_mid);
    run(mid, at_mid, hi, at_hi);
  }
};

}  // namespace

std::vector<Polynomial> signed_remainders(const Polynomial& p, const Polynomial& q) {
  std::vector<Polynomial> sequence = {p};
  Polynomial next = q;
  while (!next.is_zero()) {
    sequence.push_back(std::move(next));
    next = negative(remainder(sequence[sequence.size() - 2], sequence.back()));
  }
  return sequence;
}

int sign_changes(const std::vector<Polynomial>& sequence, const Dyadic& t) {
  int changes = 0, last = 0;
  for (const Polynomial& p : sequence) {
    const int sign = p.sign_at(t);
    if (sign == 0) continue;
    if (last == -sign) ++changes;
    last = sign;
  }
  return changes;
}

Polynomial square_free(const Polynomial& p) {
  const Polynomial common = signed_remainders(p, p.derivative()).back();
  return common.degree() == 0 ? p : exact_quotient(p, common);
}

std::vector<IsolatedRoot> roots_in_unit_interval(const Polynomial& p) {
  const Dyadic zero{0, 0}, one{1, 0};
  Isolation isolation{p, signed_remainders(p, p.derivative()), {}};
  if (p.sign_at(zero) == 0) isolation.found.push_back({zero, zero});
  isolation.run(zero, sign_changes(isolation.sequence, zero), one, sign_changes(isolation.sequence, one));
  return std::move(isolation.found);
}

int sign_at_root(const Polynomial& q, const Polynomial& p, const IsolatedRoot& root) {
  // The query depends on p' q modulo p only.
  const std::vector<Polynomial> sequence = signed_remainders(p, remainder(p.derivative() * remainder(q, p), p));
  return sign_changes(sequence, root.lo) - sign_changes(sequence, root.hi);
}

}  // namespace noli::oracle
