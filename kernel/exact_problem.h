// SPDX-License-Identifier: Apache-2.0
//
// A query in exact integers of fixed width: its forms, and what they say at one time.
//
// Notation (formula.h)
//   C                 limbs of a coordinate; a form of degree 2 then takes 2 C, one of degree 3 takes 3 C
//   view              the configuration seen along one axis: its insides, and the form that is zero when it is
//                     degenerate in this view
//   time              an object of exact_times.h, with the exact sign of quadratic forms
// Given that the points are coplanar at a time, the features meet iff, in a view that is not degenerate then, no inside
// has a sign opposite to that form's. When every view is degenerate, they meet iff one of the `degenerate_parts` holds.
//
// What this does not do: it finds no times.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "kernel/arithmetic/wide.h"
#include "kernel/bernstein.h"
#include "kernel/exact_times.h"
#include "kernel/formula.h"

namespace noli::exact {

using formula::Moving;

template <std::size_t C>
using Quadratic = Form<Wide<2 * C>, 2>;
template <std::size_t C>
using Cubic = Form<Wide<3 * C>, 3>;

template <class T, std::size_t N>
bool is_zero(const std::array<T, N>& coefficients) {
  for (const T& c : coefficients) {
    if (!c.is_zero()) return false;
  }
  return true;
}

template <class T, std::size_t N>
std::array<double, N> rounded(const std::array<T, N>& form) {
  std::array<double, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = form[i].approximate();
  return bernstein::scaled_coefficients(result);
}

template <std::size_t N>
double largest(const std::array<double, N>& c) {
  double size = 0;
  for (const double x : c) size = std::max(size, std::abs(x));
  return size;
}

/// A quadratic form, and its coefficients rounded to double: these mostly suffice for the sign at a time that is known
/// to 2^-45, and spare the long products.
template <std::size_t L>
class SignedForm {
 public:
  SignedForm() = default;
  explicit SignedForm(const Form<Wide<L>, 2>& form)
      : exact_(form), rounded_(rounded(form)), bound_(0x1p-40 * largest(rounded_)) {}

  const Form<Wide<L>, 2>& exact() const { return exact_; }

  /// The sign at all times within 2^-45 of t, if it is certain. Precondition: t in [0, 1], or not a number: then
  /// nothing is certain.
  std::optional<int> certain_sign(double t) const {
    const double value = bernstein::value_at(rounded_, t);
    if (value > bound_) return 1;
    if (value < -bound_) return -1;
    return std::nullopt;
  }

  /// The sign at `time`, of which `t` is an approximation.
  template <class Time>
  int sign(const Time& time, double t) const {
    const std::optional<int> certain = certain_sign(t);
    return certain ? *certain : time.sign(exact_);
  }

 private:
  Form<Wide<L>, 2> exact_;
  std::array<double, 3> rounded_{};
  double bound_ = 0;
};

/// Whether 0 lies between p and q: p x q = 0 and p . q <= 0.
template <std::size_t C, std::size_t Dim>
struct Between {
  static constexpr std::size_t cross_count = Dim == 3 ? 3 : 1;
  std::array<SignedForm<2 * C>, cross_count> zero;
  SignedForm<2 * C> not_positive;

  Between(const Moving<Wide<C>, Dim>& p, const Moving<Wide<C>, Dim>& q) : not_positive(formula::dot(p, q)) {
    if constexpr (Dim == 3) {
      const auto cross = formula::cross(p, q);
      zero = {SignedForm<2 * C>(cross[0]), SignedForm<2 * C>(cross[1]), SignedForm<2 * C>(cross[2])};
    } else {
      zero = {SignedForm<2 * C>(formula::cross(p, q))};
    }
  }

  template <class Time>
  bool holds(const Time& time, double t) const {
    for (const auto& form : zero) {
      if (form.sign(time, t) != 0) return false;
    }
    return not_positive.sign(time, t) <= 0;
  }
};

/// Seen along one axis: the insides, and the form that is zero when the configuration is degenerate in this view.
template <std::size_t C, std::size_t Insides>
struct View {
  std::array<SignedForm<2 * C>, Insides> insides;
  SignedForm<2 * C> degenerate;

  View(const std::array<Quadratic<C>, Insides>& forms, const Quadratic<C>& degenerate_form)
      : degenerate(degenerate_form) {
    for (std::size_t k = 0; k < Insides; ++k) insides[k] = SignedForm<2 * C>(forms[k]);
  }

  /// Given that the points are coplanar and the view is not degenerate: whether no inside has the sign opposite to
  /// `orientation`.
  template <class Time>
  bool contact(const Time& time, double t, int orientation) const {
    for (const auto& g : insides) {
      if (g.sign(time, t) * orientation < 0) return false;
    }
    return true;
  }
};

/// A vertex_face query in integers.
template <std::size_t C>
class VertexFaceProblem {
 public:
  static constexpr std::size_t insides_count = 3;
  using Vector = Moving<Wide<C>, 3>;

  explicit VertexFaceProblem(const std::array<Vector, 4>& x) : forms_{{x[1] - x[0], x[2] - x[0], x[3] - x[0]}} {}

  Cubic<C> coplanarity() const { return forms_.coplanarity(); }

  View<C, 3> view(std::size_t axis) const {
    const auto insides = forms_.insides(axis);
    return View<C, 3>(insides, formula::sum(formula::sum(insides[0], insides[1]), insides[2]));
  }

  /// The face as the union of its edges: what it is when it is degenerate in every view.
  std::array<Between<C, 3>, 3> degenerate_parts() const {
    const auto& d = forms_.d;
    return {Between<C, 3>(d[0], d[1]), Between<C, 3>(d[1], d[2]), Between<C, 3>(d[2], d[0])};
  }

 private:
  formula::VertexFace<Wide<C>> forms_;
};

/// An edge_edge query in integers.
template <std::size_t C>
class EdgeEdgeProblem {
 public:
  static constexpr std::size_t insides_count = 4;
  using Vector = Moving<Wide<C>, 3>;

  explicit EdgeEdgeProblem(const std::array<Vector, 4>& x) : x_(x), forms_{x[1] - x[0], x[3] - x[2], x[2] - x[0]} {}

  Cubic<C> coplanarity() const { return forms_.coplanarity(); }

  View<C, 4> view(std::size_t axis) const {
    return View<C, 4>(forms_.insides(axis), formula::cross_component(forms_.u, forms_.v, axis));
  }

  /// Edges that are parallel (or points) in every view meet iff an end of one lies on the other.
  std::array<Between<C, 3>, 4> degenerate_parts() const {
    const auto& [a0, a1, b0, b1] = x_;
    return {Between<C, 3>(b0 - a0, b1 - a0), Between<C, 3>(b0 - a1, b1 - a1), Between<C, 3>(a0 - b0, a1 - b0),
            Between<C, 3>(a0 - b1, a1 - b1)};
  }

 private:
  std::array<Vector, 4> x_;
  formula::EdgeEdge<Wide<C>> forms_;
};

}  // namespace noli::exact
