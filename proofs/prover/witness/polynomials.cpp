// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/witness/polynomials.h"

#include <algorithm>

namespace noli::witness {

namespace {

/// The remainder of f by g, times some number that is not 0.
Poly remainder(Poly f, const Poly& g) {
  while (f.size() >= g.size()) {
    const mpz_class lead = f.back();
    for (mpz_class& c : f) c *= g.back();
    const std::size_t shift = f.size() - g.size();
    for (std::size_t i = 0; i < g.size(); ++i) f[shift + i] -= lead * g[i];
    f = trimmed(std::move(f));
  }
  return f;
}

Poly derivative(const Poly& f) {
  Poly d;
  for (std::size_t i = 1; i < f.size(); ++i) d.push_back(f[i] * static_cast<unsigned long>(i));
  return trimmed(std::move(d));
}

}  // namespace

Poly trimmed(Poly f) {
  while (!f.empty() && f.back() == 0) f.pop_back();
  return f;
}

Poly sum(const Poly& f, const Poly& g) {
  Poly s = f;
  if (s.size() < g.size()) s.resize(g.size(), 0);
  for (std::size_t i = 0; i < g.size(); ++i) s[i] += g[i];
  return trimmed(std::move(s));
}

Poly difference(const Poly& f, const Poly& g) {
  Poly negative = g;
  for (mpz_class& c : negative) c = -c;
  return sum(f, negative);
}

Poly product(const Poly& f, const Poly& g) {
  if (f.empty() || g.empty()) return {};
  Poly p(f.size() + g.size() - 1, 0);
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; j < g.size(); ++j) p[i + j] += f[i] * g[j];
  }
  return p;
}

Poly primitive(Poly f) {
  f = trimmed(std::move(f));
  if (f.empty()) return f;
  mpz_class content = 0;
  for (const mpz_class& c : f) content = gcd(content, c);
  if (f.back() < 0) content = -content;
  for (mpz_class& c : f) c /= content;
  return f;
}

Poly greatest_common_divisor(Poly f, Poly g) {
  f = primitive(std::move(f));
  g = primitive(std::move(g));
  while (!g.empty()) {
    if (f.size() >= g.size()) f = primitive(remainder(std::move(f), g));
    std::swap(f, g);
  }
  return f;
}

Poly square_free(const Poly& f) {
  const Poly g = primitive(f);
  const Poly common = greatest_common_divisor(g, derivative(g));
  return common.size() > 1 ? primitive(quotient(g, common)) : g;
}

Poly quotient(Poly f, const Poly& g) {
  Poly q;
  while (f.size() >= g.size()) {
    const std::size_t shift = f.size() - g.size();
    if (q.empty()) q.resize(shift + 1, 0);
    mpz_divexact(q[shift].get_mpz_t(), f.back().get_mpz_t(), g.back().get_mpz_t());
    for (std::size_t i = 0; i < g.size(); ++i) f[shift + i] -= q[shift] * g[i];
    f = trimmed(std::move(f));
  }
  return q;
}

bool divides(const Poly& g, Poly f) { return remainder(trimmed(std::move(f)), g).empty(); }

int sign_at(const Poly& f, const mpz_class& at, unsigned long e) {
  mpz_class sum = 0;
  for (std::size_t i = f.size(); i-- > 0;) sum = sum * at + (f[i] << (e * (f.size() - 1 - i)));
  return sgn(sum);
}

std::vector<mpz_class> bernstein(const Poly& f, const mpz_class& l, const mpz_class& u, unsigned long e) {
  // The coefficients of f((l + u z) / (2^e (1 + z))) (1 + z)^n, which are those of Bernstein times binomials.
  std::vector<mpz_class> all(f.size(), 0);
  Poly power = {1};
  for (std::size_t k = 0; k < f.size(); ++k) {
    Poly term = power;
    for (mpz_class& c : term) c *= f[k] << (e * (f.size() - 1 - k));
    for (std::size_t i = k + 1; i < f.size(); ++i) term = product(term, {1, 1});
    for (std::size_t i = 0; i < term.size(); ++i) all[i] += term[i];
    power = product(power, {l, u});
  }
  return all;
}

int least_sign(const Poly& f, const mpz_class& l, const mpz_class& u, unsigned long e) {
  if (f.empty()) return 0;
  int least = 1;
  for (const mpz_class& c : bernstein(f, l, u, e)) least = std::min(least, sgn(c));
  return least;
}

}  // namespace noli::witness
