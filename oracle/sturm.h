// SPDX-License-Identifier: Apache-2.0
//
// Isolates the roots of a polynomial with Sturm sequences, and finds the sign of another polynomial at a root.
//
// Notation
//   sequence of (p, q)   p, q, then the negative remainder of the two before, up to positive factors; the last is the
//                        gcd of p and q
//   V(t)                 changes of sign along the sequence at t, ignoring zeros
//   square-free          without multiple roots
//
// Source: Basu, Pollack, Roy, Algorithms in Real Algebraic Geometry, section 2.2 (Sturm and Sturm-Tarski queries).
#pragma once

#include <vector>

#include "oracle/polynomial.h"

namespace noli::oracle {

/// Signed remainder sequence of (p, q). Precondition: p is not zero.
std::vector<Polynomial> signed_remainders(const Polynomial& p, const Polynomial& q);

/// V(t).
int sign_changes(const std::vector<Polynomial>& sequence, const Dyadic& t);

/// The polynomial with the roots of p, each simple. Precondition: p is not zero.
Polynomial square_free(const Polynomial& p);

/// A root of a square-free polynomial: the only one in [lo, hi], with lo < root < hi; or root = lo = hi.
struct IsolatedRoot {
  Dyadic lo, hi;
};

/// All roots of p in [0, 1] in ascending order. Precondition: p is square-free and not zero.
std::vector<IsolatedRoot> roots_in_unit_interval(const Polynomial& p);

/// The sign of q at the root of the square-free p isolated by (lo, hi), lo < hi: the Tarski query of q.
int sign_at_root(const Polynomial& q, const Polynomial& p, const IsolatedRoot& root);

}  // namespace noli::oracle
