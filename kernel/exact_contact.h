// SPDX-License-Identifier: Apache-2.0
//
// Decides contact in exact integers of fixed width.
//
// Notation (formula.h)
//   C                 limbs of a coordinate; a form of degree 2 then takes 2 C, one of degree 3 takes 3 C
//   f                 the coplanarity form
//   time              an object of exact_times.h, with the exact sign of quadratic forms
// contact_condition.h defines contact at one time. The features meet at some time of the step iff they meet at an end
// or at a root of f inside the step. If f is zero throughout, the roots of the forms whose signs decide take its place:
// the set of contact times is closed, and between such roots nothing changes.
//
// The answer for a cubic f is `unknown` if double precision on its exact coefficients cannot tell its roots apart and
// none is double, if a root of f may be within 2^-44 of a root of an inside, or if an inside has a double root.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include <noli/query.h>
#include "kernel/arithmetic/wide.h"
#include "kernel/contact_condition.h"
#include "kernel/double_filter.h"
#include "kernel/exact_times.h"

namespace noli::exact {

using bernstein::Verdict;
using filter::Decision;

template <std::size_t C>
using Cubic = Form<Wide<3 * C>, 3>;

template <class T, std::size_t N>
bool is_zero(const std::array<T, N>& coefficients) {
  return std::ranges::all_of(coefficients, [](const T& c) { return c.is_zero(); });
}

template <class T, std::size_t N>
std::array<double, N> rounded(const std::array<T, N>& form) {
  std::array<double, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = form[i].approximate();
  return bernstein::scaled_coefficients(result);
}

/// A quadratic form, and its coefficients rounded to double. These usually suffice for the sign at a time known to
/// 2^-45, and avoid the long products.
template <std::size_t L>
class SignedForm {
 public:
  SignedForm() = default;
  explicit SignedForm(const Form<Wide<L>, 2>& form)
      : exact_(form), rounded_(rounded(form)), bound_(0x1p-40 * filter::magnitude(rounded_)) {}

  const Form<Wide<L>, 2>& exact() const { return exact_; }
  bool is_zero() const { return exact::is_zero(exact_); }

  /// The sign at all times within 2^-45 of t, if it is certain. Precondition: t in [0, 1], or NaN, for which nothing is
  /// certain.
  std::optional<int> certain_sign(double t) const {
    const double value = bernstein::value_at(rounded_, t);
    if (value > bound_) return 1;
    if (value < -bound_) return -1;
    return std::nullopt;
  }

 private:
  Form<Wide<L>, 2> exact_;
  std::array<double, 3> rounded_{};
  double bound_ = 0;
};

/// Functions of contact_condition.h: quadratic forms, and the cubic one as it is. A form of degree 1 is raised to
/// degree 2 by the factor s + t = 1.
struct AsForms {
  template <std::size_t L>
  SignedForm<L> operator()(const Form<Wide<L>, 1>& form) const {
    return SignedForm<L>({form[0], form[0] + form[1], form[1]});
  }
  template <std::size_t L>
  SignedForm<L> operator()(const Form<Wide<L>, 2>& form) const {
    return SignedForm<L>(form);
  }
  template <std::size_t L>
  Form<Wide<L>, 3> operator()(const Form<Wide<L>, 3>& form) const {
    return form;
  }
};

/// A time, and its approximation in double.
template <class Time>
struct At {
  const Time& time;
  double t;

  template <std::size_t L>
  int sign(const SignedForm<L>& form) const {
    const std::optional<int> certain = form.certain_sign(t);
    return certain ? *certain : time.sign(form.exact());
  }
};

template <class Condition, class Time>
bool touches(Condition& condition, const Time& time) {
  return condition.holds(At<Time>{time, time.approximate()});
}

inline Decision contact_in(TimeEnclosure enclosure) { return {Verdict::contact, enclosure}; }

/// An interval around a time known to a relative error far below 2^-40.
inline TimeEnclosure around(double t) { return {std::max(0.0, t - 0x1p-40), std::min(1.0, t + 0x1p-40)}; }

/// Decides vertex_face and edge_edge in space: searches the times when the four points are coplanar for one when the
/// features meet.
template <class Condition, std::size_t C>
class CoplanarSearch {
  static constexpr int cubic_depth = 6;

 public:
  explicit CoplanarSearch(Condition& condition) : condition_(condition) {}

  Decision decide() {
    const Cubic<C> f = condition_.coplanarity();
    if (is_zero(f)) return decide_coplanar();
    if (f[0].is_zero() && touches(EndTime{false})) return contact_in({0, 0});
    Decision inside = decide_roots(f);
    if (inside.verdict != Verdict::contact && f[3].is_zero() && touches(EndTime{true})) {
      return contact_in({inside.verdict == Verdict::apart ? 1.0 : 0.0, 1});
    }
    return inside;
  }

 private:
  template <class Time>
  bool touches(const Time& time) {
    return exact::touches(condition_, time);
  }

  Decision decide_coplanar() {
    if (touches(EndTime{false})) return contact_in({0, 0});
    bool found = touches(EndTime{true});
    double latest = found ? 1 : 0;
    const auto visit = [&](const auto& time) {
      if (!touches(time)) return false;
      latest = time.approximate();
      return true;
    };
    found = condition_.any_critical([&](const auto& g) { return any_root(g.exact(), visit); }) || found;
    return found ? contact_in({0, around(latest).end}) : Decision{};
  }

  /// Contact at a root of f inside the step. Roots at the ends and factors s + t (no root at all) are divided out.
  Decision decide_roots(Cubic<C> f) {
    std::size_t degree = 3;
    const auto drop_first = [&] {
      for (std::size_t i = 0; i < degree; ++i) f[i] = f[i + 1];
      --degree;
    };
    while (degree > 0 && f[0].is_zero()) drop_first();
    while (degree > 0 && f[degree].is_zero()) --degree;
    while (degree > 0 && divide_by_s_plus_t(f, degree)) --degree;
    if (!changes_sign(f, degree)) return {};
    if (degree == 3) return decide_cubic(f);
    Form<Wide<3 * C>, 2> p{f[0], degree > 0 ? f[1] : Wide<3 * C>(), degree > 1 ? f[2] : Wide<3 * C>()};
    Decision decision;
    any_root(p, [&](const auto& time) {
      if (!touches(time)) return false;
      decision = contact_in(around(time.approximate()));
      return true;
    });
    return decision;
  }

  static bool divide_by_s_plus_t(Cubic<C>& f, std::size_t degree) {
    Cubic<C> quotient = f;
    for (std::size_t i = 1; i < degree; ++i) quotient[i] = f[i] - quotient[i - 1];
    if (!(f[degree] - quotient[degree - 1]).is_zero()) return false;
    f = quotient;
    return true;
  }

  static bool changes_sign(const Cubic<C>& f, std::size_t degree) {
    const int sign = f[0].sign();
    for (std::size_t i = 1; i <= degree; ++i) {
      if (f[i].sign() * sign < 0) return true;
    }
    return false;
  }

  /// Root by root in double, now on the exact coefficients; signs of insides at a root that stay unclear are computed
  /// exactly. Error bounds: a coefficient is rounded to 2^-51 of itself and multiplied once; a run of de Casteljau has
  /// three levels of 3 * 2^-53.
  Decision decide_cubic(const Cubic<C>& f) {
    const auto approximation = rounded(f);
    const double bound = 0x1p-49 * filter::magnitude(approximation);
    const filter::RoundedCubic cubic{approximation, bound, bound};
    const auto inside = [&](double low, double high, int f_before) { return inside_at_root(f, {low, high, f_before}); };
    const Decision decision = filter::RootSearch(cubic, inside).run(cubic_depth);
    return decision.verdict == Verdict::unknown ? decide_double_root(f) : decision;
  }

  /// What is known about a root of f: where it is, and the sign of f before it.
  struct RootOfCubic {
    double low, high;
    int f_before;
  };

  Verdict inside_at_root(const Cubic<C>& f, const RootOfCubic& root) {
    bool positive = false, negative = false, open = false;
    for (const auto& g : condition_.insides()) {
      const std::optional<int> sign = sign_at_root(g, f, root);
      positive |= sign.value_or(0) > 0;
      negative |= sign.value_or(0) < 0;
      open |= !sign;
    }
    if (positive && negative) return Verdict::apart;
    return open || positive == negative ? Verdict::unknown : Verdict::contact;
  }

  /// The sign of g at a root alpha of f: the sign of g at root.low, changed once by each root of g in between. The sign
  /// of f at a root of g tells whether it comes before alpha.
  static std::optional<int> sign_at_root(const SignedForm<2 * C>& g, const Cubic<C>& f, const RootOfCubic& root) {
    constexpr double margin = 0x1p-44;  // far above the error of an approximate root
    if (is_zero(g.exact())) return 0;
    std::optional<int> sign = g.certain_sign(root.low);
    if (!sign || discriminant(g.exact()).is_zero()) return std::nullopt;
    any_root(g.exact(), [&](const auto& time) {
      const double t = time.approximate();
      if (t < root.low - margin || t > root.high + margin) return false;
      const int f_there = time.sign(f);
      if (t < root.low + margin || t > root.high - margin)
        sign = std::nullopt;
      else if (f_there == 0)
        sign = 0;
      else if (f_there == root.f_before)
        sign = -*sign;
      return !sign || *sign == 0;
    });
    return sign;
  }

  /// A cubic with a double root has rational roots: the double one at (9 f0 f3 - f1 f2) / (2 (f2^2 - 3 f1 f3)), unless
  /// it is triple, and the simple one at -f2 / f3 minus twice that.
  Decision decide_double_root(const Cubic<C>& f) {
    const Wide<C> two(2), three(3), nine(9);
    const auto t = narrowed(nine * (f[0] * f[3])) - f[1] * f[2];
    const auto s = narrowed(two * (f[2] * f[2] - narrowed(three * (f[1] * f[3]))));
    if (s.is_zero()) return filter::undecided;
    const RationalTime<6 * C> time = rational_time(s, t);
    const Form<Wide<4 * C>, 2> derivative{Wide<4 * C>(f[1]), two * f[2], three * f[3]};
    if (time.sign(f) != 0 || time.sign(derivative) != 0) return filter::undecided;
    if (time.t.sign() > 0 && touches(time)) return contact_in({0, around(time.approximate()).end});
    return decide_simple_root(f, time);
  }

  Decision decide_simple_root(const Cubic<C>& f, const RationalTime<6 * C>& double_root) {
    const RationalTime<9 * C> time =
        rational_time(f[3] * double_root.s, -(f[2] * double_root.s) - (f[3] * double_root.t + f[3] * double_root.t));
    if (time.t.sign() <= 0 || !touches(time)) return {};
    return contact_in(around(time.approximate()));
  }

  /// Drops the highest limb(s) that a product with a small constant added; the others have enough bits for it.
  static Wide<6 * C> narrowed(const Wide<7 * C>& x) {
    Wide<6 * C> result;
    for (std::size_t i = 0; i < 6 * C; ++i) result.limb(i) = x.limb(i);
    return result;
  }

  Condition& condition_;
};

/// Decides the other problems. Contacts begin only at t = 0, where an equality holds, or where a critical form
/// vanishes.
template <class Condition>
Decision decide_others(Condition& condition) {
  if (touches(condition, EndTime{false})) return contact_in({0, 0});
  Decision decision;
  const auto visit = [&](const auto& time) {
    if (!touches(condition, time)) return false;
    decision = contact_in(around(time.approximate()));
    return true;
  };
  if (const auto* equality = condition.equality()) {
    any_root(equality->exact(), visit);
  } else {
    condition.any_critical([&](const auto& g) { return any_root(g.exact(), visit); });
  }
  if (decision.verdict != Verdict::contact && touches(condition, EndTime{true})) return contact_in({1, 1});
  return decision;
}

/// Whether points with C limbs a coordinate meet. `axis`: along which to look first.
template <FeaturePair Pair, std::size_t C, std::size_t Dim, std::size_t N>
Decision decide(const std::array<formula::Moving<Wide<C>, Dim>, N>& points, std::size_t axis) {
  auto condition = condition::make<Pair, AsForms>(points, axis);
  if constexpr (Pair == FeaturePair::vertex_face || Pair == FeaturePair::edge_edge) {
    return CoplanarSearch<decltype(condition), C>(condition).decide();
  } else {
    return decide_others(condition);
  }
}

}  // namespace noli::exact
