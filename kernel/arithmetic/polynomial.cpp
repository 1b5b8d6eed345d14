// SPDX-License-Identifier: Apache-2.0
#include "kernel/arithmetic/polynomial.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace noli {
namespace {

// --- modulo a prime

constexpr std::uint64_t prime = 0x1fffffffffffffffu;  // 2^61 - 1

using Residues = std::vector<std::uint64_t>;

__extension__ using Product = unsigned __int128;

std::uint64_t multiply(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::uint64_t>(static_cast<Product>(a) * b % prime);
}

Residues residues(const Polynomial& p) {
  Residues r(static_cast<std::size_t>(p.degree() + 1));
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = mpz_fdiv_ui(p[i].get(), prime);
  return r;
}

void trim(Residues& r) {
  while (!r.empty() && r.back() == 0) r.pop_back();
}

/// a := lead(b)^k a mod b. Precondition: b is not empty, neither has a leading zero.
void reduce(Residues& a, const Residues& b) {
  while (a.size() >= b.size()) {
    const std::uint64_t factor = prime - a.back(), lead = b.back();
    const std::size_t shift = a.size() - b.size();
    for (std::size_t i = 0; i < a.size(); ++i) {
      const std::uint64_t own = multiply(a[i], lead);
      a[i] = i < shift ? own : (own + multiply(factor, b[i - shift])) % prime;
    }
    trim(a);
  }
}

// --- over the integers

/// A constant multiple of the remainder of a by b.
Polynomial pseudo_remainder(const Polynomial& a, const Polynomial& b) {
  std::vector<Integer> r;
  for (int i = 0; i <= a.degree(); ++i) r.push_back(a[static_cast<std::size_t>(i)]);
  const std::size_t size = static_cast<std::size_t>(b.degree()) + 1;
  while (r.size() >= size) {
    const Integer factor = r.back();
    const std::size_t shift = r.size() - size;
    for (std::size_t i = 0; i + 1 < r.size(); ++i) {
      r[i] *= b.leading();
      if (i >= shift) mpz_submul(r[i].get(), factor.get(), b[i - shift].get());
    }
    r.pop_back();
  }
  return Polynomial(std::move(r));
}

}  // namespace

Integer Polynomial::scaled_value(const Integer& m, std::size_t e) const {
  if (c_.empty()) return {};
  Integer value = c_.back(), term;
  for (std::size_t i = c_.size() - 1; i-- > 0;) {
    value *= m;
    mpz_mul_2exp(term.get(), c_[i].get(), e * (c_.size() - 1 - i));
    value += term;
  }
  return value;
}

int Polynomial::sign_at_rational(const Integer& num, const Integer& den) const {
  if (c_.empty()) return 0;
  Integer value = c_.back(), power(1);
  for (std::size_t i = c_.size() - 1; i-- > 0;) {
    value *= num;
    power *= den;
    mpz_addmul(value.get(), c_[i].get(), power.get());
  }
  return value.sign();
}

Polynomial& Polynomial::operator+=(const Polynomial& b) {
  if (c_.size() < b.c_.size()) c_.resize(b.c_.size());
  for (std::size_t i = 0; i < b.c_.size(); ++i) c_[i] += b.c_[i];
  trim();
  return *this;
}

Polynomial& Polynomial::operator-=(const Polynomial& b) {
  if (c_.size() < b.c_.size()) c_.resize(b.c_.size());
  for (std::size_t i = 0; i < b.c_.size(); ++i) c_[i] -= b.c_[i];
  trim();
  return *this;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Integer> c(a.c_.size() + b.c_.size() - 1);
  for (std::size_t i = 0; i < a.c_.size(); ++i) {
    for (std::size_t j = 0; j < b.c_.size(); ++j) mpz_addmul(c[i + j].get(), a.c_[i].get(), b.c_[j].get());
  }
  return Polynomial(std::move(c));
}

Polynomial Polynomial::derivative() const {
  std::vector<Integer> d(c_.empty() ? 0 : c_.size() - 1);
  for (std::size_t i = 0; i < d.size(); ++i) mpz_mul_ui(d[i].get(), c_[i + 1].get(), i + 1);
  return Polynomial(std::move(d));
}

Integer Polynomial::content() const {
  Integer g;
  for (const Integer& c : c_) mpz_gcd(g.get(), g.get(), c.get());
  return g;
}

Polynomial Polynomial::primitive() const {
  if (c_.empty()) return {};
  Integer divisor = content();
  if (leading().sign() < 0) divisor.negate();
  Polynomial result;
  for (const Integer& c : c_) result.c_.push_back(divide_exactly(c, divisor));
  return result;
}

Polynomial Polynomial::without_power_of_two() const {
  std::size_t zeros = std::numeric_limits<std::size_t>::max();
  for (const Integer& c : c_) {
    if (!c.is_zero()) zeros = std::min(zeros, trailing_zeros(c));
  }
  Polynomial result = *this;
  if (zeros == 0) return result;
  for (Integer& c : result.c_) c >>= zeros;
  return result;
}

Integer Polynomial::coefficient_sum() const {
  Integer sum;
  for (const Integer& c : c_) (c.sign() < 0 ? sum -= c : sum += c);
  return sum;
}

Polynomial from_form(std::vector<Integer> form) {
  // t^i (1 - t)^k contributes to t^i ... t^(i + k), k = n - i. Goes down, so that it reads only unchanged entries.
  for (std::size_t i = form.size(); i-- > 0;) {
    const std::size_t k = form.size() - 1 - i;
    Integer term = form[i];
    for (std::size_t j = 1; j <= k; ++j) {
      mpz_mul_ui(term.get(), term.get(), k - j + 1);
      mpz_divexact_ui(term.get(), term.get(), j);
      term.negate();
      form[i + j] += term;
    }
  }
  return Polynomial(std::move(form));
}

int sign_changes(const std::vector<Integer>& numbers) {
  int changes = 0, last = 0;
  for (const Integer& c : numbers) {
    if (c.sign() * last < 0) ++changes;
    if (c.sign() != 0) last = c.sign();
  }
  return changes;
}

bool surely_coprime(const Polynomial& a, const Polynomial& b) {
  Residues x = residues(a), y = residues(b);
  if (x.back() == 0 || y.back() == 0) return false;  // then a common factor might vanish modulo the prime
  while (!y.empty()) {
    reduce(x, y);
    std::swap(x, y);
  }
  return x.size() == 1;
}

Polynomial gcd(const Polynomial& a, const Polynomial& b) {
  Polynomial x = a.primitive(), y = b.primitive();
  while (!y.is_zero()) {
    Polynomial r = x.degree() < y.degree() ? x : pseudo_remainder(x, y).primitive();
    x = std::exchange(y, std::move(r));
  }
  return x;
}

Polynomial quotient(Polynomial a, const Polynomial& b) {
  const std::size_t size = b.c_.size();
  std::vector<Integer> q(a.c_.size() < size ? 0 : a.c_.size() - size + 1);
  for (std::size_t i = q.size(); i-- > 0;) {
    q[i] = divide_exactly(a.c_[i + size - 1], b.leading());
    for (std::size_t j = 0; j < size; ++j) mpz_submul(a.c_[i + j].get(), q[i].get(), b.c_[j].get());
  }
  return Polynomial(std::move(q));
}

Polynomial square_free_part(const Polynomial& p) {
  if (p.degree() <= 1) return p;
  const Polynomial d = p.derivative();
  if (surely_coprime(p, d)) return p;
  const Polynomial common = gcd(p, d);
  return common.degree() == 0 ? p : quotient(p, common).primitive();
}

}  // namespace noli
