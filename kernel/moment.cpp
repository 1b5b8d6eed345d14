// SPDX-License-Identifier: Apache-2.0
#include "kernel/moment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace noli {
namespace {

/// The least e with x <= 2^e. Precondition: x > 0.
int exponent_above(const Dyadic& x) {
  const auto bits = static_cast<int>(x.m.bit_length()), e = static_cast<int>(x.e);
  const bool power_of_two = trailing_zeros(x.m) + 1 == x.m.bit_length();
  return power_of_two ? bits - 1 - e : bits - e;
}

/// sigma = from + s length.
struct AffineMap {
  Dyadic from, length;

  Dyadic operator()(const Dyadic& s) const { return from + s * length; }

  /// B^n p(s) as a polynomial in sigma, where s = (2^k sigma - A) / B with integers A, B.
  Polynomial operator()(const Polynomial& p) const {
    const std::size_t k = std::max(from.e, length.e);
    const Integer a = from.scaled(k), b = length.scaled(k);
    const Polynomial shifted({-a, Integer(1) << k});
    Polynomial q;
    Integer power(1);
    for (int i = p.degree(); i >= 0; --i) {
      q = q * shifted + Polynomial({p[static_cast<std::size_t>(i)] * power});
      power *= b;
    }
    return q;
  }
};

AlgebraicNumber mapped(const AlgebraicNumber& s, const AffineMap& map) {
  if (s.is_dyadic()) return AlgebraicNumber(map(s.low()));
  return {std::make_shared<const Polynomial>(map(s.polynomial()).primitive()), map(s.low()), map(s.high())};
}

}  // namespace

Moment::Moment(const Window& window, double begin, double end, const TimeOfImpact& s)
    : origin_(Dyadic::from_double(window.begin)), exponent_(exponent_above(Dyadic::from_double(window.end) - origin_)) {
  const Dyadic from = Dyadic::from_double(begin), to = Dyadic::from_double(end);
  sigma_ = mapped(s.algebraic(), {ldexp(from - origin_, -exponent_), ldexp(to - from, -exponent_)});
}

int Moment::compare(double t) const { return sigma_.compare(ldexp(Dyadic::from_double(t) - origin_, -exponent_)); }

/// The largest double <= this time and the smallest >= it.
std::pair<double, double> Moment::neighbours() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  AlgebraicNumber finer = sigma_;
  for (std::size_t bits = 64;; bits *= 2) {
    if (!finer.is_dyadic()) finer.refine(bits);
    const double low = floor_to_double(origin_ + ldexp(finer.low(), exponent_));
    const double high = ceil_to_double(origin_ + ldexp(finer.high(), exponent_));
    if (low == high || std::nextafter(low, infinity) == high) return {low, high};
    const double middle = std::nextafter(low, infinity);
    if (std::nextafter(middle, infinity) != high) continue;
    const int side = compare(middle);
    return {side < 0 ? low : middle, side > 0 ? high : middle};
  }
}

double Moment::lower() const {
  const auto [low, high] = neighbours();
  return high != low && compare(high) == 0 ? high : low;
}

double Moment::upper() const {
  const auto [low, high] = neighbours();
  return high != low && compare(low) == 0 ? low : high;
}

}  // namespace noli
