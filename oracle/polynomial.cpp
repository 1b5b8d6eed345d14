// SPDX-License-Identifier: Apache-2.0
#include "oracle/polynomial.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace noli::oracle {

namespace {

Integer shifted(const Integer& a, unsigned long bits) {
  Integer result;
  mpz_mul_2exp(result.get_mpz_t(), a.get_mpz_t(), bits);
  return result;
}

/// The numerator of `a` over 2^exponent. Precondition: exponent >= a.exponent.
Integer numerator_over(const Dyadic& a, unsigned long exponent) { return shifted(a.numerator, exponent - a.exponent); }

/// One division step, which lowers the degree of `r`: r := |lead(b)| r - (+-lead(r)) t^k b. Returns the factor of
/// t^k b.
Integer eliminate(std::vector<Integer>& r, const Polynomial& b) {
  const std::size_t n = static_cast<std::size_t>(b.degree()), k = r.size() - 1 - n;
  Integer factor = sgn(b.leading()) > 0 ? r.back() : Integer(-r.back());
  const Integer scale = abs(b.leading());
  for (Integer& x : r) x *= scale;
  for (std::size_t i = 0; i <= n; ++i) mpz_submul(r[i + k].get_mpz_t(), factor.get_mpz_t(), b[i].get_mpz_t());
  return factor;
}

std::vector<Integer> coefficients(const Polynomial& p) {
  std::vector<Integer> c;
  for (int i = 0; i <= p.degree(); ++i) c.push_back(p[static_cast<std::size_t>(i)]);
  return c;
}

void drop_leading_zeros(std::vector<Integer>& c) {
  while (!c.empty() && sgn(c.back()) == 0) c.pop_back();
}

}  // namespace

int compare(const Dyadic& a, const Dyadic& b) {
  const unsigned long exponent = std::max(a.exponent, b.exponent);
  return sgn(numerator_over(a, exponent) - numerator_over(b, exponent));
}

Dyadic middle(const Dyadic& a, const Dyadic& b) {
  const unsigned long exponent = std::max(a.exponent, b.exponent);
  return {numerator_over(a, exponent) + numerator_over(b, exponent), exponent + 1};
}

Dyadic exactly(double d) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(d, &exponent), 53);  // an integer
  const long power = static_cast<long>(exponent) - 53;
  if (power >= 0) return {shifted(Integer(mantissa), static_cast<unsigned long>(power)), 0};
  return {Integer(mantissa), static_cast<unsigned long>(-power)};
}

Polynomial::Polynomial(std::vector<Integer> coefficients) : c_(std::move(coefficients)) { trim(); }

void Polynomial::trim() { drop_leading_zeros(c_); }

Polynomial Polynomial::linear(const Integer& at_t0, const Integer& at_t1) { return Polynomial({at_t0, at_t1 - at_t0}); }

Polynomial Polynomial::constant(const Integer& value) { return Polynomial({value}); }

Polynomial Polynomial::derivative() const {
  std::vector<Integer> result;
  for (std::size_t i = 1; i < c_.size(); ++i) result.emplace_back(c_[i] * static_cast<unsigned long>(i));
  return Polynomial(std::move(result));
}

Polynomial Polynomial::primitive() const {
  if (is_zero()) return *this;
  Integer divisor = abs(c_.back());
  for (const Integer& x : c_) {
    if (divisor == 1) return *this;
    divisor = gcd(divisor, x);
  }
  Polynomial result = *this;
  for (Integer& x : result.c_) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
  return result;
}

int Polynomial::sign_at(const Dyadic& t) const {
  // Horner on the homogeneous form: the sign of sum c[i] numerator^i (2^exponent)^(degree - i).
  Integer value = 0;
  for (std::size_t i = c_.size(), lower = 0; i-- > 0; ++lower) {
    value *= t.numerator;
    value += shifted(c_[i], t.exponent * lower);
  }
  return sgn(value);
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial result = a.degree() >= b.degree() ? a : b;
  const Polynomial& other = a.degree() >= b.degree() ? b : a;
  for (std::size_t i = 0; i < other.c_.size(); ++i) result.c_[i] += other.c_[i];
  result.trim();
  return result;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
  Polynomial result = a;
  result.c_.resize(std::max(a.c_.size(), b.c_.size()));
  for (std::size_t i = 0; i < b.c_.size(); ++i) result.c_[i] -= b.c_[i];
  result.trim();
  return result;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Integer> c(a.c_.size() + b.c_.size() - 1);
  for (std::size_t i = 0; i < a.c_.size(); ++i) {
    for (std::size_t j = 0; j < b.c_.size(); ++j) {
      mpz_addmul(c[i + j].get_mpz_t(), a.c_[i].get_mpz_t(), b.c_[j].get_mpz_t());
    }
  }
  return Polynomial(std::move(c));
}

Polynomial remainder(const Polynomial& a, const Polynomial& b) {
  std::vector<Integer> r = coefficients(a);
  while (r.size() > static_cast<std::size_t>(b.degree())) {
    eliminate(r, b);
    drop_leading_zeros(r);
  }
  return Polynomial(std::move(r)).primitive();
}

Polynomial exact_quotient(const Polynomial& a, const Polynomial& b) {
  std::vector<Integer> r = coefficients(a);
  std::vector<Integer> quotient(r.size() - static_cast<std::size_t>(b.degree()));
  const Integer scale = abs(b.leading());
  while (r.size() > static_cast<std::size_t>(b.degree())) {
    const std::size_t k = r.size() - 1 - static_cast<std::size_t>(b.degree());
    for (Integer& x : quotient) x *= scale;
    quotient[k] += eliminate(r, b);
    drop_leading_zeros(r);
  }
  return Polynomial(std::move(quotient)).primitive();
}

int sign_throughout(const Polynomial& p, const Dyadic& lo, const Dyadic& hi) {
  if (p.is_zero()) return 0;
  const unsigned long exponent = std::max(lo.exponent, hi.exponent);
  const Integer a = numerator_over(lo, exponent);
  const Integer width = numerator_over(hi, exponent) - a;
  // Coefficients of 2^(exponent degree) p((a + x) / 2^exponent) by repeated Horner steps.
  std::vector<Integer> c = coefficients(p);
  const std::size_t n = c.size() - 1;
  for (std::size_t i = 0; i < n; ++i) c[i] = shifted(c[i], exponent * (n - i));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = n; j-- > i;) mpz_addmul(c[j].get_mpz_t(), a.get_mpz_t(), c[j + 1].get_mpz_t());
  }
  Integer bound = 0, power = 1;
  for (std::size_t i = 1; i <= n; ++i) {
    power *= width;
    bound += abs(c[i]) * power;
  }
  return abs(c[0]) > bound ? sgn(c[0]) : 0;
}

}  // namespace noli::oracle
