// SPDX-License-Identifier: Apache-2.0
//
// Polynomials in the time with integer coefficients, for witnesses.
//
// Notation
//   Poly   coefficients, the constant term first; the last is not 0, and the zero polynomial has none
//
// What this does not do: it is not fast.
#pragma once

#include <gmpxx.h>

#include <vector>

namespace noli::witness {

using Poly = std::vector<mpz_class>;

Poly trimmed(Poly f);
Poly sum(const Poly& f, const Poly& g);
Poly difference(const Poly& f, const Poly& g);
Poly product(const Poly& f, const Poly& g);
/// Without the common factor of its coefficients, the last one positive.
Poly primitive(Poly f);
/// Primitive. gcd(f, 0) is f.
Poly greatest_common_divisor(Poly f, Poly g);
/// With the same roots, each once. Precondition: f is not 0.
Poly square_free(const Poly& f);
/// f / g, whose coefficients are integers by Gauss's lemma. Precondition: g is primitive, and divides f over the
/// rational numbers.
Poly quotient(Poly f, const Poly& g);
/// Whether g divides f over the rational numbers. Precondition: g is not 0.
bool divides(const Poly& g, Poly f);
/// Sign of f(at / 2^e).
int sign_at(const Poly& f, const mpz_class& at, unsigned long e);
/// The Bernstein coefficients of f on [l / 2^e, u / 2^e], times positive numbers. The polynomial 0 has no coefficients.
std::vector<mpz_class> bernstein(const Poly& f, const mpz_class& l, const mpz_class& u, unsigned long e);
/// The least sign of the Bernstein coefficients of f on [l / 2^e, u / 2^e].
int least_sign(const Poly& f, const mpz_class& l, const mpz_class& u, unsigned long e);

}  // namespace noli::witness
