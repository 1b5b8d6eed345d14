// SPDX-License-Identifier: Apache-2.0
//
// Contact at one instant as a condition on signs of functions of time, for every pair of features.
//
// Notation (formula.h): forms are homogeneous in (1 - t, t); coordinates are integers, the query's times a common power
// of two.
//   Functions         makes a function of a form: a polynomial (AsPolynomials), or a form of fixed width
//                     (kernel/exact_contact.h)
//   Time              anything with `int sign(function)`: the sign at that time
//   equality          a function that is zero at every contact and not identically zero, if there is one
//   critical          if there is no equality: functions between whose roots `holds` does not change
//   transversal       given that the condition holds: the contact is of codimension one and relatively interior to
//                     both features
// A condition provides: equality() (pointer or null), any_critical(visit), holds(time), transversal(time).
// any_critical() calls visit(function) for one critical function after another until it returns true, and returns that.
//
// T is the integer type of the coordinates: Wide<1> or Wide<2> if they fit, which saves most of the time, else Integer.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <noli/query.h>
#include "kernel/arithmetic/polynomial.h"
#include "kernel/arithmetic/wide.h"
#include "kernel/formula.h"

namespace noli::condition {

using formula::Form;
using formula::Moving;

inline Integer integer_of(const Integer& x) { return x; }

template <std::size_t N>
Integer integer_of(const Wide<N>& x) {
  const Wide<N> magnitude = x.is_negative() ? -x : x;
  Integer result;
  std::array<std::uint64_t, N> limbs;
  for (std::size_t i = 0; i < N; ++i) limbs[i] = magnitude.limb(i);
  mpz_import(result.get(), N, -1, sizeof(std::uint64_t), 0, 0, limbs.data());
  return x.is_negative() ? -std::move(result) : result;
}

struct AsPolynomials {
  template <class T, std::size_t N>
  Polynomial operator()(const std::array<T, N>& form) const {
    std::vector<Integer> c;
    c.reserve(N);
    for (const T& x : form) c.push_back(integer_of(x));
    return from_form(std::move(c));
  }
};

/// The functions of several forms.
template <class Functions, class F, std::size_t N>
auto functions_of(const std::array<F, N>& forms) {
  std::array<decltype(Functions{}(forms[0])), N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = Functions{}(forms[i]);
  return result;
}

template <class Zero, class Time>
bool all_zero(const Zero& functions, const Time& time) {
  return std::ranges::all_of(functions, [&time](const auto& f) { return time.sign(f) == 0; });
}

template <class Function, std::size_t N>
const Function* first_nonzero(const std::array<Function, N>& functions) {
  for (const Function& f : functions) {
    if (!f.is_zero()) return &f;
  }
  return nullptr;
}

/// 0 lies between p and q: p x q = 0 and p . q <= 0. The condition of vertex_edge, with p, q the ends of the edge seen
/// from the vertex.
template <class T, std::size_t Dim, class Functions>
class Between {
 public:
  Between(const Moving<T, Dim>& p, const Moving<T, Dim>& q)
      : zero_(functions_of<Functions>(cross(p, q))), product_(Functions{}(formula::dot(p, q))) {}

  auto equality() const { return first_nonzero(zero_); }

  template <class Visit>
  bool any_critical(Visit&& visit) const {
    return visit(product_);
  }
  /// any_critical() for callers that know nothing about the equality.
  template <class Visit>
  bool any_function(Visit&& visit) const {
    return std::ranges::any_of(zero_, std::ref(visit)) || visit(product_);
  }

  template <class Time>
  bool holds(const Time& time) const {
    return all_zero(zero_, time) && time.sign(product_) <= 0;
  }
  template <class Time>
  bool transversal(const Time& time) const {
    return Dim == 2 && time.sign(product_) < 0;
  }

 private:
  static auto cross(const Moving<T, Dim>& p, const Moving<T, Dim>& q) {
    if constexpr (Dim == 3) {
      return formula::cross(p, q);
    } else {
      return std::array<decltype(formula::cross(p, q)), 1>{formula::cross(p, q)};
    }
  }

  decltype(functions_of<Functions>(cross(Moving<T, Dim>{}, Moving<T, Dim>{}))) zero_;
  typename decltype(zero_)::value_type product_;
};

/// Two points coincide.
template <class T, std::size_t Dim, class Functions>
class Coincide {
 public:
  explicit Coincide(const Moving<T, Dim>& d) {
    for (std::size_t i = 0; i < Dim; ++i) zero_[i] = Functions{}(Form<T, 1>{d.at_t0[i], d.at_t1[i]});
  }

  auto equality() const { return first_nonzero(zero_); }
  template <class Visit>
  static bool any_critical(Visit&&) {
    return false;
  }

  template <class Time>
  bool holds(const Time& time) const {
    return all_zero(zero_, time);
  }
  template <class Time>
  static bool transversal(const Time&) {
    return false;
  }

 private:
  std::array<decltype(Functions{}(Form<T, 1>{})), Dim> zero_;
};

/// vertex_face in space: its forms, and the function that is zero when the configuration is degenerate in a view.
template <class T, class Functions>
struct VertexFace {
  explicit VertexFace(const std::array<Moving<T, 3>, 4>& x) : forms{{x[1] - x[0], x[2] - x[0], x[3] - x[0]}} {}

  static auto degenerate(const auto& insides, std::size_t) {
    return formula::sum(formula::sum(insides[0], insides[1]), insides[2]);
  }
  /// A face that is degenerate in every view is the union of its edges.
  auto degenerate_parts() const {
    const auto& d = forms.d;
    return std::array<Between<T, 3, Functions>, 3>{{{d[0], d[1]}, {d[1], d[2]}, {d[2], d[0]}}};
  }

  formula::VertexFace<T> forms;
};

/// The same for edge_edge.
template <class T, class Functions>
struct EdgeEdge {
  explicit EdgeEdge(const std::array<Moving<T, 3>, 4>& x) : points(x), forms{x[1] - x[0], x[3] - x[2], x[2] - x[0]} {}

  auto degenerate(const auto&, std::size_t axis) const { return formula::cross_component(forms.u, forms.v, axis); }
  /// Edges that are parallel (or points) in every view meet iff an end of one lies on the other.
  auto degenerate_parts() const {
    const auto& [a0, a1, b0, b1] = points;
    return std::array<Between<T, 3, Functions>, 4>{
        {{b0 - a0, b1 - a0}, {b0 - a1, b1 - a1}, {a0 - b0, a1 - b0}, {a0 - b1, a1 - b1}}};
  }

  std::array<Moving<T, 3>, 4> points;
  formula::EdgeEdge<T> forms;
};

/// vertex_face and edge_edge in space, at a time when the points are coplanar. If some view is not degenerate at that
/// time, the features meet iff no inside has the sign opposite to View::degenerate in it. If every view is degenerate,
/// they meet iff one of the degenerate parts does.
template <class Problem, class Functions>
class CodimensionOne {
 public:
  /// `axis`: along which to look first. Any axis is correct; one along which the configuration looks large is faster.
  template <class Points>
  explicit CodimensionOne(const Points& x, std::size_t axis = 0)
      : problem_(x), axis_(axis), coplanarity_(Functions{}(problem_.forms.coplanarity())) {}

  const auto& coplanarity() const { return coplanarity_; }
  const Polynomial* equality() const { return coplanarity_.is_zero() ? nullptr : &coplanarity_; }
  /// The insides seen along the first axis.
  const auto& insides() { return view(0).insides; }

  /// Visits the functions of the first view that is not degenerate throughout; if all are, those of the parts.
  template <class Visit>
  bool any_critical(Visit&& visit) {
    for (std::size_t i = 0; i < 3; ++i) {
      const View& seen = view(i);
      if (seen.degenerate.is_zero()) continue;
      return visit(seen.degenerate) || std::ranges::any_of(seen.insides, std::ref(visit));
    }
    return std::ranges::any_of(parts(), [&visit](const auto& part) { return part.any_function(visit); });
  }

  /// Precondition: the points are coplanar at this time.
  template <class Time>
  bool holds(const Time& time) {
    const Inside inside = inside_at(time);
    if (inside != Inside::degenerate) return inside != Inside::outside;
    return std::ranges::any_of(parts(), [&time](const auto& part) { return part.holds(time); });
  }

  template <class Time>
  bool transversal(const Time& time) {
    return inside_at(time) == Inside::interior;
  }

 private:
  enum class Inside { outside, border, interior, degenerate };

  using Insides = decltype(functions_of<Functions>(std::declval<Problem>().forms.insides(0)));

  /// Seen along one axis: the insides, and a function that is zero when the configuration is degenerate in this view.
  struct View {
    Insides insides;
    typename Insides::value_type degenerate;
  };

  /// Along the i-th axis from the first.
  const View& view(std::size_t i) {
    const std::size_t axis = (axis_ + i) % 3;
    if (!views_[axis]) {
      const auto insides = problem_.forms.insides(axis);
      views_[axis] = View{functions_of<Functions>(insides), Functions{}(problem_.degenerate(insides, axis))};
    }
    return *views_[axis];
  }

  const auto& parts() {
    if (!parts_) parts_ = problem_.degenerate_parts();
    return *parts_;
  }

  template <class Time>
  Inside inside_at(const Time& time) {
    for (std::size_t i = 0; i < 3; ++i) {
      const View& seen = view(i);
      const int orientation = time.sign(seen.degenerate);
      if (orientation != 0) return inside_view(seen, time, orientation);
    }
    return Inside::degenerate;
  }

  template <class Time>
  static Inside inside_view(const View& seen, const Time& time, int orientation) {
    Inside result = Inside::interior;
    for (const auto& g : seen.insides) {
      const int sign = time.sign(g) * orientation;
      if (sign < 0) return Inside::outside;
      if (sign == 0) result = Inside::border;
    }
    return result;
  }

  Problem problem_;
  std::size_t axis_;
  decltype(Functions{}(std::declval<Problem>().forms.coplanarity())) coplanarity_;
  std::array<std::optional<View>, 3> views_;
  std::optional<decltype(std::declval<Problem>().degenerate_parts())> parts_;
};

/// The condition of a pair of features whose points move as x. `axis`: as for CodimensionOne.
template <FeaturePair Pair, class Functions = AsPolynomials, class T, std::size_t Dim, std::size_t N>
auto make(const std::array<Moving<T, Dim>, N>& x, [[maybe_unused]] std::size_t axis = 0) {
  if constexpr (Pair == FeaturePair::vertex_face) {
    return CodimensionOne<VertexFace<T, Functions>, Functions>(x, axis);
  } else if constexpr (Pair == FeaturePair::edge_edge) {
    return CodimensionOne<EdgeEdge<T, Functions>, Functions>(x, axis);
  } else if constexpr (Pair == FeaturePair::vertex_edge) {
    return Between<T, Dim, Functions>(x[1] - x[0], x[2] - x[0]);
  } else {
    return Coincide<T, Dim, Functions>(x[1] - x[0]);
  }
}

}  // namespace noli::condition
