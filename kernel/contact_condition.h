// SPDX-License-Identifier: Apache-2.0
//
// Contact at one instant as a condition on signs of integer polynomials in time, for every pair of features.
//
// Notation (formula.h): forms are homogeneous in (1 - t, t); coordinates are integers, the query's times a common power
// of two.
//   Time              anything with `int sign(const Polynomial&)`: the sign at that time
//   equality          a polynomial that is zero at every contact, and not zero throughout; none if there is no such
//   critical          when there is no equality: polynomials between whose roots `holds` does not change
//   transversal       given that it holds: the contact is of codimension one and relatively interior to both features
// A condition provides: equality() (pointer or null), critical(), holds(time), transversal(time).
//
// T is the integer type of the coordinates: Wide<1> and Wide<2> when they fit, which saves most of the time, else
// Integer.
//
// What this does not do: it finds no times.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "kernel/arithmetic/polynomial.h"
#include "kernel/arithmetic/wide.h"
#include "kernel/formula.h"
#include "kernel/query.h"

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

template <class T, std::size_t N>
Polynomial polynomial_of(const std::array<T, N>& form) {
  std::vector<Integer> c;
  c.reserve(N);
  for (const T& x : form) c.push_back(integer_of(x));
  return from_form(std::move(c));
}

template <class T, std::size_t N>
auto polynomials_of(const std::array<T, N>& forms) {
  std::vector<Polynomial> result;
  result.reserve(N);
  for (const T& form : forms) result.push_back(polynomial_of(form));
  return result;
}

template <class Time>
bool all_zero(const std::vector<Polynomial>& polynomials, const Time& time) {
  for (const Polynomial& p : polynomials) {
    if (time.sign(p) != 0) return false;
  }
  return true;
}

inline const Polynomial* first_nonzero(const std::vector<Polynomial>& polynomials) {
  for (const Polynomial& p : polynomials) {
    if (!p.is_zero()) return &p;
  }
  return nullptr;
}

/// 0 lies between p and q: p x q = 0 and p . q <= 0. The condition of vertex_edge, with p, q the ends of the edge seen
/// from the vertex.
template <int Dim>
class Between {
 public:
  template <class T>
  Between(const Moving<T, Dim>& p, const Moving<T, Dim>& q) : product_(polynomial_of(formula::dot(p, q))) {
    if constexpr (Dim == 3) {
      zero_ = polynomials_of(formula::cross(p, q));
    } else {
      zero_.push_back(polynomial_of(formula::cross(p, q)));
    }
  }

  const Polynomial* equality() const { return first_nonzero(zero_); }
  std::vector<Polynomial> critical() const { return {product_}; }

  template <class Time>
  bool holds(const Time& time) const {
    return all_zero(zero_, time) && time.sign(product_) <= 0;
  }
  template <class Time>
  bool transversal(const Time& time) const {
    return Dim == 2 && time.sign(product_) < 0;
  }

  const std::vector<Polynomial>& zero() const { return zero_; }
  const Polynomial& product() const { return product_; }

 private:
  std::vector<Polynomial> zero_;
  Polynomial product_;
};

/// Two points coincide.
class Coincide {
 public:
  template <class T, std::size_t Dim>
  explicit Coincide(const Moving<T, Dim>& d) {
    for (std::size_t i = 0; i < Dim; ++i) zero_.push_back(polynomial_of(Form<T, 1>{d.at_t0[i], d.at_t1[i]}));
  }

  const Polynomial* equality() const { return first_nonzero(zero_); }
  static std::vector<Polynomial> critical() { return {}; }

  template <class Time>
  bool holds(const Time& time) const {
    return all_zero(zero_, time);
  }
  template <class Time>
  static bool transversal(const Time&) {
    return false;
  }

 private:
  std::vector<Polynomial> zero_;
};

template <class T>
formula::VertexFace<T> vertex_face(const std::array<Moving<T, 3>, 4>& x) {
  return {{x[1] - x[0], x[2] - x[0], x[3] - x[0]}};
}

template <class T>
formula::EdgeEdge<T> edge_edge(const std::array<Moving<T, 3>, 4>& x) {
  return {x[1] - x[0], x[3] - x[2], x[2] - x[0]};
}

/// A face that is degenerate in every view is the union of its edges.
template <class T>
std::vector<Between<3>> degenerate_parts(const std::array<Moving<T, 3>, 4>&, const formula::VertexFace<T>& forms) {
  const auto& d = forms.d;
  return {{d[0], d[1]}, {d[1], d[2]}, {d[2], d[0]}};
}

/// Edges that are parallel in every view meet iff an end of one lies on the other.
template <class T>
std::vector<Between<3>> degenerate_parts(const std::array<Moving<T, 3>, 4>& x, const formula::EdgeEdge<T>&) {
  const auto& [a0, a1, b0, b1] = x;
  return {{b0 - a0, b1 - a0}, {b0 - a1, b1 - a1}, {a0 - b0, a1 - b0}, {a0 - b1, a1 - b1}};
}

/// vertex_face and edge_edge in space.
template <class T, class Forms>
class CodimensionOne {
 public:
  CodimensionOne(const std::array<Moving<T, 3>, 4>& x, const Forms& forms)
      : x_(x), forms_(forms), coplanarity_(polynomial_of(forms.coplanarity())) {}

  const Polynomial* equality() const { return coplanarity_.is_zero() ? nullptr : &coplanarity_; }

  /// The forms of the first view that is not degenerate throughout; if there is none, those of the parts.
  std::vector<Polynomial> critical() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const View& seen = view(axis);
      if (seen.degenerate.is_zero()) continue;
      std::vector<Polynomial> result = seen.insides;
      result.push_back(seen.degenerate);
      return result;
    }
    std::vector<Polynomial> result;
    for (const auto& part : parts()) {
      result.insert(result.end(), part.zero().begin(), part.zero().end());
      result.push_back(part.product());
    }
    return result;
  }

  /// Precondition: the points are coplanar at this time.
  template <class Time>
  bool holds(const Time& time) {
    const Inside inside = inside_at(time);
    if (inside != Inside::degenerate) return inside != Inside::outside;
    for (const auto& part : parts()) {
      if (part.holds(time)) return true;
    }
    return false;
  }

  template <class Time>
  bool transversal(const Time& time) {
    return inside_at(time) == Inside::interior;
  }

 private:
  enum class Inside { outside, border, interior, degenerate };

  /// Seen along one axis: the insides, and what is zero when the configuration is degenerate in this view.
  struct View {
    std::vector<Polynomial> insides;
    Polynomial degenerate;
  };

  static auto degenerate_form(const formula::VertexFace<T>&, const auto& insides, std::size_t) {
    auto sum = insides[0];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + insides[1][i] + insides[2][i];
    return sum;
  }
  static auto degenerate_form(const formula::EdgeEdge<T>& forms, const auto&, std::size_t axis) {
    return formula::cross_component(forms.u, forms.v, axis);
  }

  const View& view(std::size_t axis) {
    if (!views_[axis]) {
      const auto insides = forms_.insides(axis);
      views_[axis] = View{polynomials_of(insides), polynomial_of(degenerate_form(forms_, insides, axis))};
    }
    return *views_[axis];
  }

  const std::vector<Between<3>>& parts() {
    if (!parts_) parts_ = degenerate_parts(x_, forms_);
    return *parts_;
  }

  template <class Time>
  Inside inside_at(const Time& time) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const View& seen = view(axis);
      const int orientation = time.sign(seen.degenerate);
      if (orientation != 0) return inside_view(seen, time, orientation);
    }
    return Inside::degenerate;
  }

  template <class Time>
  static Inside inside_view(const View& seen, const Time& time, int orientation) {
    Inside result = Inside::interior;
    for (const Polynomial& g : seen.insides) {
      const int sign = time.sign(g) * orientation;
      if (sign < 0) return Inside::outside;
      if (sign == 0) result = Inside::border;
    }
    return result;
  }

  std::array<Moving<T, 3>, 4> x_;
  Forms forms_;
  Polynomial coplanarity_;
  std::array<std::optional<View>, 3> views_;
  std::optional<std::vector<Between<3>>> parts_;
};

/// The condition of a pair of features whose points move as x.
template <FeaturePair Pair, class T, std::size_t Dim, std::size_t N>
auto make(const std::array<Moving<T, Dim>, N>& x) {
  if constexpr (Pair == FeaturePair::vertex_face) {
    return CodimensionOne<T, formula::VertexFace<T>>(x, vertex_face(x));
  } else if constexpr (Pair == FeaturePair::edge_edge) {
    return CodimensionOne<T, formula::EdgeEdge<T>>(x, edge_edge(x));
  } else if constexpr (Pair == FeaturePair::vertex_edge) {
    return Between<Dim>(x[1] - x[0], x[2] - x[0]);
  } else {
    return Coincide(x[1] - x[0]);
  }
}

}  // namespace noli::condition
