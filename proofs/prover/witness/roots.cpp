// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/witness/roots.h"

#include <algorithm>
#include <utility>

namespace noli::witness {

namespace {

/// How often the sign changes along the coefficients; zeros do not count. 0: no root inside of the interval; 1: one.
int sign_changes(const std::vector<mpz_class>& coefficients) {
  int changes = 0, last = 0;
  for (const mpz_class& c : coefficients) {
    if (sgn(c) == 0) continue;
    changes += sgn(c) * last < 0 ? 1 : 0;
    last = sgn(c);
  }
  return changes;
}

/// The same in as few bits as are enough, so that there is room to go on.
Root shortened(Root root) {
  unsigned long spare = root.e;
  for (const mpz_class* bound : {&root.l, &root.u}) {
    if (*bound != 0) spare = std::min(spare, mpz_scan1(bound->get_mpz_t(), 0));
  }
  root.l >>= spare;
  root.u >>= spare;
  root.e -= spare;
  return root;
}

/// Adds the roots strictly between l and u.
void add_inside(const Poly& f, const Root& within, std::vector<Root>& roots) {
  const auto& [l, u, e] = within;
  const auto coefficients = bernstein(f, l, u, e);
  const int changes = sign_changes(coefficients);
  if (changes == 0) return;
  if (changes == 1 && coefficients.front() != 0 && coefficients.back() != 0) return roots.push_back(within);
  if (e == most_root_bits) return;
  const mpz_class middle = l + u;
  if (sign_at(f, middle, e + 1) == 0) roots.push_back({middle, middle, e + 1});
  add_inside(f, shortened({2 * l, middle, e + 1}), roots);
  add_inside(f, shortened({middle, 2 * u, e + 1}), roots);
}

}  // namespace

std::vector<Root> roots_within(const Poly& f, const mpz_class& from, const mpz_class& to, unsigned long e) {
  std::vector<Root> roots;
  if (sign_at(f, from, e) == 0) roots.push_back({from, from, e});
  if (from == to) return roots;
  add_inside(f, shortened({from, to, e}), roots);
  if (sign_at(f, to, e) == 0) roots.push_back(shortened({from, to, e}));
  return roots;
}

bool changes_sign(const Poly& f, const Root& root) {
  return sign_at(f, root.l, root.e) * sign_at(f, root.u, root.e) <= 0;
}

bool refine(const Poly& f, Root& root) {
  if (root.l == root.u || root.e == most_root_bits) return false;
  const mpz_class middle = root.l + root.u;
  const int at_middle = sign_at(f, middle, root.e + 1), at_u = sign_at(f, root.u, root.e);
  root = {2 * root.l, 2 * root.u, root.e + 1};
  if (at_u == 0) {
    root.l = middle;
  } else if (at_middle == 0) {
    root.l = root.u = middle;
  } else {
    (at_middle == at_u ? root.u : root.l) = middle;
  }
  root = shortened(std::move(root));
  return true;
}

}  // namespace noli::witness
