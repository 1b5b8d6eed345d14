// SPDX-License-Identifier: Apache-2.0
//
// Times of a step at which a polynomial of degree 2 vanishes, in closed form, and the exact sign of other quadratic
// forms at them.
//
// Notation (formula.h)
//   z = t / s         in (0, infinity) for t inside the step: a form of degree n is a polynomial in z, c[0] + c[1] z +
//                     ... + c[n] z^n
//   p                 the form that vanishes, D = p1^2 - 4 p0 p2
//   g                 a form of degree 2 or 3 whose sign is asked for
//
// Widths: let the coefficients of p be below 2^P and those of g below 2^G in magnitude. The largest number in the
// computation of a sign is below 2^(4 P + 2 G + 7) for a g of degree 2, and below 2^(6 P + 2 G + 7) for one of degree
// 3;
// less at a RationalTime with s and t below 2^P. With p in W and g in L limbs it takes 4 W + 2 L and 6 W + 2 L limbs.
//
// Times at which only a polynomial of degree 3 vanishes are not here: they have no closed form in these numbers.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "kernel/arithmetic/wide.h"
#include "kernel/formula.h"

namespace noli::exact {

using formula::Form;

/// One end of the step.
struct EndTime {
  bool at_t1;

  template <std::size_t L>
  int sign(const Form<Wide<L>, 2>& g) const {
    return (at_t1 ? g[2] : g[0]).sign();
  }
  double approximate() const { return at_t1 ? 1 : 0; }
};

/// The rational time t / (s + t), s > 0. It is inside the step iff t > 0; sign() works for other times too.
template <std::size_t W>
struct RationalTime {
  Wide<W> s, t;

  template <std::size_t L>
  int sign(const Form<Wide<L>, 2>& g) const {
    return (g[0] * (s * s) + g[1] * (s * t) + g[2] * (t * t)).sign();
  }
  template <std::size_t L>
  int sign(const Form<Wide<L>, 3>& g) const {
    const auto ss = s * s, st = s * t, tt = t * t;
    return (g[0] * (ss * s) + g[1] * (ss * t) + g[2] * (st * t) + g[3] * (tt * t)).sign();
  }
  /// NaN when s or t is beyond the range of double; callers then take the exact way.
  double approximate() const {
    const double a = s.approximate(), b = t.approximate(), sum = a + b;
    return std::isfinite(sum) ? b / sum : std::numeric_limits<double>::quiet_NaN();
  }
};

/// The time t / (s + t) for s other than 0.
template <std::size_t W>
RationalTime<W> rational_time(const Wide<W>& s, const Wide<W>& t) {
  return s.is_negative() ? RationalTime<W>{-s, -t} : RationalTime<W>{s, t};
}

/// The time with z = (-p1 + root sqrt(D)) / (2 p2), where p2 > 0, D > 0, root = +-1.
template <std::size_t W>
struct QuadraticTime {
  Form<Wide<W>, 2> p;
  Wide<2 * W> discriminant;
  int root;

  /// g(z) has the sign of p2 g(z) - g2 p(z), which is linear.
  template <std::size_t L>
  int sign(const Form<Wide<L>, 2>& g) const {
    return sign_of_linear(p[2] * g[0] - p[0] * g[2], p[2] * g[1] - p[1] * g[2]);
  }

  /// Two such steps for a g of degree 3: e = p2 g - g3 z p, then p2 e - e2 p.
  template <std::size_t L>
  int sign(const Form<Wide<L>, 3>& g) const {
    const auto e0 = p[2] * g[0], e1 = p[2] * g[1] - p[0] * g[3], e2 = p[2] * g[2] - p[1] * g[3];
    return sign_of_linear(p[2] * e0 - p[0] * e2, p[2] * e1 - p[1] * e2);
  }

  /// h0 + h1 z has the sign of X + Y sqrt(D) with X = 2 p2 h0 - p1 h1, Y = root h1.
  template <std::size_t H>
  int sign_of_linear(const Wide<H>& h0, const Wide<H>& h1) const {
    const auto twice_p2 = p[2] + p[2];
    const auto x = twice_p2 * h0 - p[1] * h1;
    const int sign_x = x.sign(), sign_y = root * h1.sign();
    if (sign_y == 0 || sign_x == sign_y) return sign_x;
    if (sign_x == 0) return sign_y;
    return sign_x * (x * x - h1 * h1 * discriminant).sign();
  }

  /// Avoids cancellation: of the two expressions of a root, takes the one whose terms have the same sign.
  double approximate() const {
    const double p0 = p[0].approximate(), p1 = p[1].approximate(), p2 = p[2].approximate();
    const double r = root * std::sqrt(discriminant.approximate());
    const double z = (p1 <= 0) == (r >= 0) ? (r - p1) / (2 * p2) : (2 * p0) / (-p1 - r);
    return z / (1 + z);
  }
};

/// The sign of p1^2 - 4 p0 p2 decides how many roots there are.
template <std::size_t W>
Wide<2 * W> discriminant(const Form<Wide<W>, 2>& p) {
  const auto product = p[0] * p[2];
  const auto twice = product + product;
  return p[1] * p[1] - (twice + twice);
}

/// Calls visit(time) for each time inside the step at which p0 s + p1 t is zero; stops when visit returns true, and
/// returns that.
template <std::size_t W, class Visit>
bool any_linear_root(const Wide<W>& p0, const Wide<W>& p1, Visit&& visit) {
  return p0.sign() * p1.sign() < 0 && visit(rational_time(p1, -p0));
}

/// The same for a form of degree 2, in ascending order. A form that is zero throughout has no roots to visit.
template <std::size_t W, class Visit>
bool any_root(Form<Wide<W>, 2> p, Visit&& visit) {
  if (p[2].is_zero()) return any_linear_root(p[0], p[1], visit);
  if (p[0].is_zero()) return any_linear_root(p[1], p[2], visit);
  if (p[2].is_negative()) p = {-p[0], -p[1], -p[2]};
  const bool one_root = p[0].is_negative();
  if (!one_root && p[1].sign() >= 0) return false;
  const auto d = discriminant(p);
  if (d.is_negative()) return false;
  if (d.is_zero()) return visit(RationalTime<W>{p[2] + p[2], -p[1]});
  if (!one_root && visit(QuadraticTime<W>{p, d, -1})) return true;
  return visit(QuadraticTime<W>{p, d, +1});
}

}  // namespace noli::exact
