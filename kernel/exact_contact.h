// SPDX-License-Identifier: Apache-2.0
//
// Contact decided in exact integers of fixed width.
//
// Notation (formula.h): f is the coplanarity form; a *time* is an object of exact_times.h with the exact sign of
// quadratic forms. The features meet at some time of the step iff they meet at an end, or at a root of f inside, or,
// when f is zero throughout, at a root inside of one of the forms on whose signs the answer depends: the set of contact
// times is closed, and between such roots nothing changes.
//
// What this does not do: when double precision, applied to the exact coefficients of a cubic f, cannot tell its roots
// apart and none is double, or when it cannot tell a root of f from one of an inside's beyond 2^-44, the answer is
// `unknown`.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "kernel/arithmetic/wide.h"
#include "kernel/double_filter.h"
#include "kernel/exact_problem.h"
#include "kernel/exact_times.h"
#include "kernel/query.h"

namespace noli::exact {

using bernstein::Verdict;
using filter::Decision;

inline Decision contact_in(TimeEnclosure enclosure) { return {Verdict::contact, enclosure}; }

/// An interval around a time known to a relative error far below 2^-40.
inline TimeEnclosure around(double t) { return {std::max(0.0, t - 0x1p-40), std::min(1.0, t + 0x1p-40)}; }

/// Decides a problem of codimension one: vertex_face and edge_edge in space.
template <class Problem, std::size_t C>
class CodimensionOne {
  static constexpr int cubic_depth = 6;

 public:
  /// `axis`: along which to look first; any is right, one along which the configuration looks large is faster.
  CodimensionOne(const Problem& problem, std::size_t axis) : problem_(problem), axis_(axis) {}

  Decision decide() {
    const Cubic<C> f = problem_.coplanarity();
    if (is_zero(f)) return decide_coplanar();
    if (f[0].is_zero() && touches(EndTime{false})) return contact_in({0, 0});
    Decision inside = decide_roots(f);
    if (inside.verdict != Verdict::contact && f[3].is_zero() && touches(EndTime{true})) {
      return contact_in({inside.verdict == Verdict::apart ? 1.0 : 0.0, 1});
    }
    return inside;
  }

 private:
  static constexpr std::size_t insides_count = Problem::insides_count;

  const View<C, insides_count>& view(std::size_t axis) {
    if (!views_[axis]) views_[axis] = problem_.view(axis);
    return *views_[axis];
  }

  /// Given that the points are coplanar at this time: whether the features meet.
  template <class Time>
  bool touches(const Time& time) {
    const double t = time.approximate();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& seen = view((axis_ + i) % 3);
      const int orientation = seen.degenerate.sign(time, t);
      if (orientation != 0) return seen.contact(time, t, orientation);
    }
    for (const auto& part : problem_.degenerate_parts()) {
      if (part.holds(time, t)) return true;
    }
    return false;
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
    found = any_critical_root(visit) || found;
    return found ? contact_in({0, around(latest).end}) : Decision{};
  }

  /// Roots of the forms on whose signs `touches` depends, when the points are coplanar throughout.
  template <class Visit>
  bool any_critical_root(Visit&& visit) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& seen = view((axis_ + i) % 3);
      if (is_zero(seen.degenerate.exact())) continue;
      if (any_root(seen.degenerate.exact(), visit)) return true;
      for (const auto& g : seen.insides) {
        if (any_root(g.exact(), visit)) return true;
      }
      return false;
    }
    for (const auto& part : problem_.degenerate_parts()) {
      for (const auto& form : part.zero) {
        if (any_root(form.exact(), visit)) return true;
      }
      if (any_root(part.not_positive.exact(), visit)) return true;
    }
    return false;
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

  /// Root by root in double, now on the exact coefficients; where that does not tell the sign of an inside at a root,
  /// exactly. Error bounds: a coefficient is rounded to 2^-51 of itself and multiplied once; a run of de Casteljau has
  /// three levels of 3 * 2^-53.
  Decision decide_cubic(const Cubic<C>& f) {
    const auto approximation = rounded(f);
    const double bound = 0x1p-49 * largest(approximation);
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
    for (const auto& g : view(axis_).insides) {
      const std::optional<int> sign = sign_at_root(g, f, root);
      positive |= sign.value_or(0) > 0;
      negative |= sign.value_or(0) < 0;
      open |= !sign;
    }
    if (positive && negative) return Verdict::apart;
    return open || positive == negative ? Verdict::unknown : Verdict::contact;
  }

  /// The sign of g at a root alpha of f: that of g before alpha, changed once by each root of g in between. Whether a
  /// root of g comes before alpha is told by the sign of f there.
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
    auto t = narrowed(nine * (f[0] * f[3])) - f[1] * f[2];
    auto s = narrowed(two * (f[2] * f[2] - narrowed(three * (f[1] * f[3]))));
    if (s.is_zero()) return {Verdict::unknown, {}};
    if (s.is_negative()) {
      s = -s;
      t = -t;
    }
    const RationalTime<6 * C> time{s, t};
    if (time.sign(f) != 0 || !is_double_root(f, time)) return {Verdict::unknown, {}};
    if (t.sign() > 0 && touches(time)) return contact_in({0, around(time.approximate()).end});
    return decide_simple_root(f, time);
  }

  template <class Time>
  static bool is_double_root(const Cubic<C>& f, const Time& time) {
    const Wide<C> two(2), three(3);
    const Form<Wide<4 * C>, 2> derivative{Wide<4 * C>(f[1]), two * f[2], three * f[3]};
    return time.sign(derivative) == 0;
  }

  Decision decide_simple_root(const Cubic<C>& f, const RationalTime<6 * C>& double_root) {
    auto s = f[3] * double_root.s;
    auto t = -(f[2] * double_root.s) - (f[3] * double_root.t + f[3] * double_root.t);
    if (s.is_negative()) {
      s = -s;
      t = -t;
    }
    const RationalTime<9 * C> time{s, t};
    if (t.sign() <= 0 || !touches(time)) return {};
    return contact_in(around(time.approximate()));
  }

  /// Drops the highest limb(s) that a product with a small constant added; the bits for it are there.
  static Wide<6 * C> narrowed(const Wide<7 * C>& x) {
    Wide<6 * C> result;
    for (std::size_t i = 0; i < 6 * C; ++i) result.limb(i) = x.limb(i);
    return result;
  }

  const Problem& problem_;
  std::size_t axis_;
  std::array<std::optional<View<C, insides_count>>, 3> views_;
};

/// Decides the other problems: the features meet iff all of `zero` vanish and `not_positive` is not positive at the
/// same time.
template <std::size_t L, std::size_t N>
class ZeroSet {
 public:
  ZeroSet(const std::array<SignedForm<L>, N>& zero, const SignedForm<L>& not_positive)
      : zero_(zero), not_positive_(not_positive) {}

  Decision decide() const {
    if (holds(EndTime{false})) return contact_in({0, 0});
    Decision decision;
    any_root(critical_form(), [&](const auto& time) {
      if (!holds(time)) return false;
      decision = contact_in(around(time.approximate()));
      return true;
    });
    if (decision.verdict != Verdict::contact && holds(EndTime{true})) return contact_in({1, 1});
    return decision;
  }

 private:
  template <class Time>
  bool holds(const Time& time) const {
    const double t = time.approximate();
    for (const auto& form : zero_) {
      if (form.sign(time, t) != 0) return false;
    }
    return not_positive_.sign(time, t) <= 0;
  }

  /// Contacts begin only where this one vanishes, or at t = 0.
  const Form<Wide<L>, 2>& critical_form() const {
    for (const auto& form : zero_) {
      if (!is_zero(form.exact())) return form.exact();
    }
    return not_positive_.exact();
  }

  std::array<SignedForm<L>, N> zero_;
  SignedForm<L> not_positive_;
};

/// A vertex and an edge: 0 between the two ends of the edge, seen from the vertex.
template <std::size_t C, std::size_t Dim>
Decision decide_vertex_edge(const std::array<Moving<Wide<C>, Dim>, 3>& x) {
  const Between<C, Dim> between(x[1] - x[0], x[2] - x[0]);
  return ZeroSet<2 * C, Between<C, Dim>::cross_count>(between.zero, between.not_positive).decide();
}

/// Two vertices: every coordinate of their difference vanishes. Each, of degree 1, is raised to degree 2 by the factor
/// s + t = 1.
template <std::size_t C, std::size_t Dim>
Decision decide_vertex_vertex(const std::array<Moving<Wide<C>, Dim>, 2>& x) {
  const auto d = x[1] - x[0];
  std::array<SignedForm<C>, Dim> zero;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    zero[axis] = SignedForm<C>({d.at_t0[axis], d.at_t0[axis] + d.at_t1[axis], d.at_t1[axis]});
  }
  return ZeroSet<C, Dim>(zero, {}).decide();
}

}  // namespace noli::exact
