// SPDX-License-Identifier: Apache-2.0
//
// Encloses real roots of polynomials with integer coefficients by dyadic fractions.
//
// Algorithm: bisection, guided by the signs of Bernstein coefficients (Descartes' rule).
#pragma once

#include <vector>

#include "kernel/arithmetic/polynomial.h"

namespace noli::witness {

/// A root in [l / 2^e, u / 2^e]. The polynomial is 0 at an end, or has different signs at the ends.
struct Root {
  Integer l, u;
  std::size_t e;
};

/// No enclosure has a larger e: the limit of proofs/FORMAT.md, section 5.
constexpr std::size_t most_root_bits = 8192;

/// The least sign of the Bernstein coefficients of f on [l / 2^e, u / 2^e].
int least_sign(const Polynomial& f, const Root& root);

/// The roots of f in [from / 2^e, to / 2^e], in any order. A root at an end is enclosed with l < u, unless from = to.
/// Roots that are too near each other for most_root_bits are left out, except one at an end. Precondition: f is
/// square-free and of degree at least 1.
std::vector<Root> roots_within(const Polynomial& f, const Integer& from, const Integer& to, std::size_t e);

/// Whether f is 0 at an end of the enclosure, or has different signs at its ends.
bool changes_sign(const Polynomial& f, const Root& root);

/// Halves the enclosure of a root of f. False if it is a single time, or e is at its limit.
bool refine(const Polynomial& f, Root& root);

}  // namespace noli::witness
