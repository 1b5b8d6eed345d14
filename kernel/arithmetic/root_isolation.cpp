// SPDX-License-Identifier: Apache-2.0
//
// Isolates the roots of an integer polynomial in [0, 1].
//
// Notation: b[i] are the Bernstein coefficients of p on a piece [m / 2^k, (m + 1) / 2^k], times a positive constant
// that makes them integers. The number of their sign changes bounds the number of roots inside and has the same parity;
// if it is 0 or 1, it is the number of roots.
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/arithmetic/algebraic.h"

namespace noli {
namespace {

using Bernstein = std::vector<Integer>;

struct Piece {
  Bernstein b;
  Integer m;
  std::size_t k = 0;
};

/// b[i] = sum over j <= i of binomial(i, j) / binomial(n, j) c[j], times n!.
Bernstein bernstein_of(const Polynomial& p) {
  const std::size_t n = static_cast<std::size_t>(p.degree());
  Bernstein b(n + 1);
  Integer weight;
  mpz_fac_ui(weight.get(), n);  // n! / binomial(n, j)
  for (std::size_t j = 0; j <= n; ++j) {
    b[j] = p[j] * weight;
    mpz_mul_ui(weight.get(), weight.get(), j + 1);
    if (j < n) mpz_divexact_ui(weight.get(), weight.get(), n - j);
  }
  // Sums with binomial weights are the inverse of differences.
  for (std::size_t level = 1; level <= n; ++level) {
    for (std::size_t i = n; i >= level; --i) b[i] += b[i - 1];
  }
  return b;
}

/// de Casteljau at the middle, without the division by two: both halves are scaled by 2^n.
std::pair<Piece, Piece> halves(const Piece& piece) {
  const std::size_t n = piece.b.size() - 1;
  Piece left{Bernstein(n + 1), piece.m << 1, piece.k + 1}, right{piece.b, (piece.m << 1) + Integer(1), piece.k + 1};
  for (std::size_t level = 0; level <= n; ++level) {
    left.b[level] = right.b[0] << (n - level);
    for (std::size_t i = 0; i + level < n; ++i) right.b[i] += right.b[i + 1];
  }
  for (std::size_t i = 0; i <= n; ++i) right.b[i] <<= i;
  return {std::move(left), std::move(right)};
}

/// Newton's method from the zero of the chord, kept inside (0, 1), on the piece's own coordinate.
double local_root(const std::vector<double>& a) {
  double at_one = 0;
  for (const double c : a) at_one += c;
  double low = 0, high = 1, x = a[0] / (a[0] - at_one);
  if (!(x > 0 && x < 1)) x = 0.5;
  for (int step = 0; step < 30; ++step) {
    double value = 0, slope = 0;
    for (std::size_t i = a.size(); i-- > 0;) {
      slope = slope * x + value;
      value = value * x + a[i];
    }
    ((value < 0) == (a[0] < 0) ? low : high) = x;
    double next = x - value / slope;
    if (!(next >= low && next <= high)) next = low + (high - low) / 2;
    if (std::abs(next - x) <= x * 0x1p-50) return next;
    x = next;
  }
  return x;
}

/// The power basis of the piece in doubles, up to a factor, by differences taken exactly.
std::vector<double> local_polynomial(const Piece& piece) {
  Bernstein d = piece.b;
  const std::size_t n = d.size() - 1;
  for (std::size_t level = 1; level <= n; ++level) {
    for (std::size_t i = n; i >= level; --i) d[i] -= d[i - 1];
  }
  std::size_t top = 1;
  for (const Integer& c : d) top = std::max(top, c.bit_length());
  std::vector<double> a;
  double binomial = 1;
  for (std::size_t i = 0; i <= n; ++i) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, d[i].get());
    a.push_back(binomial * std::ldexp(mantissa, static_cast<int>(std::max(exponent - static_cast<long>(top), -1000L))));
    binomial = binomial * static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return a;
}

/// Isolates the roots inside (0, 1) of a square-free polynomial that is not zero at 0 and 1.
class Isolation {
 public:
  explicit Isolation(Polynomial p) : p_(std::make_shared<const Polynomial>(std::move(p))) {}

  /// False when a dyadic root was found on the way, which the caller must divide out first.
  bool run() { return p_->degree() < 1 || visit({bernstein_of(*p_), Integer(), 0}); }
  const Dyadic& dyadic_root() const { return dyadic_root_; }
  std::vector<AlgebraicNumber>& roots() { return roots_; }

 private:
  bool visit(const Piece& piece) {
    const int changes = sign_changes(piece.b);
    if (changes == 0) return true;
    if (changes == 1) return add(piece);
    auto [left, right] = halves(piece);
    if (!right.b[0].is_zero()) return visit(left) && visit(right);
    dyadic_root_ = {right.m, right.k};
    return false;
  }

  bool add(const Piece& piece) {
    if (p_->degree() == 1) {
      roots_.push_back(
          AlgebraicNumber::rational(p_->leading().sign() < 0 ? (*p_)[0] : -(*p_)[0], absolute(p_->leading())));
      return true;
    }
    AlgebraicNumber number(p_, {piece.m, piece.k}, {piece.m + Integer(1), piece.k});
    if (piece.k < 1000) {
      const double root = mpz_get_d(piece.m.get()) + local_root(local_polynomial(piece));
      number.polish(std::ldexp(root, -static_cast<int>(piece.k)));
    }
    roots_.push_back(std::move(number));
    return true;
  }

  std::shared_ptr<const Polynomial> p_;
  Dyadic dyadic_root_;
  std::vector<AlgebraicNumber> roots_;
};

/// Removes the root from p.
void divide_out(Polynomial& p, const AlgebraicNumber& root) {
  p = quotient(p, root.polynomial()).without_power_of_two();
}

void divide_out_if_root(Polynomial& p, const Dyadic& x, std::vector<AlgebraicNumber>& roots) {
  if (p.sign_at(x) != 0) return;
  roots.emplace_back(x);
  divide_out(p, roots.back());
}

}  // namespace

std::vector<AlgebraicNumber> roots_in_unit_interval(const Polynomial& p) {
  std::vector<AlgebraicNumber> exact;
  Polynomial rest = square_free_part(p.without_power_of_two());
  divide_out_if_root(rest, Dyadic{}, exact);
  divide_out_if_root(rest, Dyadic::from_integer(1), exact);
  for (;;) {
    Isolation isolation(rest);
    if (isolation.run()) {
      auto& roots = isolation.roots();
      roots.insert(roots.end(), exact.begin(), exact.end());
      std::sort(roots.begin(), roots.end());
      return std::move(roots);
    }
    exact.emplace_back(isolation.dyadic_root());
    divide_out(rest, exact.back());
  }
}

}  // namespace noli
