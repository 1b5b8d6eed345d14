// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/witness/roots.h"

#include <algorithm>
#include <utility>

namespace noli::witness {

namespace {

/// The Bernstein coefficients of f on [l / 2^e, u / 2^e], times positive numbers. The polynomial 0 has no coefficients.
std::vector<Integer> bernstein(const Polynomial& f, const Root& within) {
  // The coefficients of f((l + u z) / (2^e (1 + z))) (1 + z)^n are the Bernstein coefficients times binomials.
  const Polynomial line({within.l, within.u}), one_more({Integer(1), Integer(1)});
  const auto n = static_cast<std::size_t>(f.degree()) + 1;
  Polynomial sum, power({Integer(1)});
  for (std::size_t k = 0; k < n; ++k) {
    Polynomial term = power * Polynomial({f[k] << (within.e * (n - 1 - k))});
    for (std::size_t i = k + 1; i < n; ++i) term = term * one_more;
    sum += term;
    power = power * line;
  }
  std::vector<Integer> all(n);
  for (std::size_t i = 0; i < static_cast<std::size_t>(sum.degree()) + 1; ++i) all[i] = sum[i];
  return all;
}

/// The same enclosure with the fewest bits, so that there is room for further halving.
Root shortened(Root root) {
  std::size_t spare = root.e;
  for (const Integer* bound : {&root.l, &root.u}) {
    if (!bound->is_zero()) spare = std::min(spare, trailing_zeros(*bound));
  }
  root.l >>= spare;
  root.u >>= spare;
  root.e -= spare;
  return root;
}

/// Adds the roots strictly between l and u.
void add_inside(const Polynomial& f, const Root& within, std::vector<Root>& roots) {
  const auto& [l, u, e] = within;
  const auto coefficients = bernstein(f, within);
  const int changes = sign_changes(coefficients);
  if (changes == 0) return;  // no root inside the interval; with one change there is one
  if (changes == 1 && !coefficients.front().is_zero() && !coefficients.back().is_zero()) return roots.push_back(within);
  if (e == most_root_bits) return;
  const Integer middle = l + u;
  if (f.sign_at({middle, e + 1}) == 0) roots.push_back({middle, middle, e + 1});
  add_inside(f, shortened({l << 1, middle, e + 1}), roots);
  add_inside(f, shortened({middle, u << 1, e + 1}), roots);
}

}  // namespace

int least_sign(const Polynomial& f, const Root& root) {
  if (f.is_zero()) return 0;
  int least = 1;
  for (const Integer& c : bernstein(f, root)) least = std::min(least, c.sign());
  return least;
}

std::vector<Root> roots_within(const Polynomial& f, const Integer& from, const Integer& to, std::size_t e) {
  std::vector<Root> roots;
  if (f.sign_at({from, e}) == 0) roots.push_back({from, from, e});
  if (from == to) return roots;
  add_inside(f, shortened({from, to, e}), roots);
  if (f.sign_at({to, e}) == 0) roots.push_back(shortened({from, to, e}));
  return roots;
}

bool changes_sign(const Polynomial& f, const Root& root) {
  return f.sign_at({root.l, root.e}) * f.sign_at({root.u, root.e}) <= 0;
}

bool refine(const Polynomial& f, Root& root) {
  if (root.l == root.u || root.e == most_root_bits) return false;
  const Integer middle = root.l + root.u;
  const int at_middle = f.sign_at({middle, root.e + 1}), at_u = f.sign_at({root.u, root.e});
  root = {root.l << 1, root.u << 1, root.e + 1};
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
