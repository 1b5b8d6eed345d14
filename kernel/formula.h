// SPDX-License-Identifier: Apache-2.0
//
// The formulas behind every predicate, written once, as templates over the number type: double (with an error bound
// kept by the caller), CGAL::Interval_nt, integers of fixed width, GMP integers. The type may grow from product to
// product.
//
// Notation
//   s = 1 - t         so that a point moving linearly is s x_t0 + t x_t1
//   Form              a homogeneous polynomial in (s, t): c[0] s^n + c[1] s^(n-1) t + ... + c[n] t^n. Its values on s +
//                     t = 1 are those of the polynomial; c[i] is binomial(n, i) times the Bernstein coefficient; c[0]
//                     and c[n] are the values at the ends
//   vertex_face       d_i = f_i - v, i = 0, 1, 2. The face holds the vertex iff 0 is in the hull of the d_i
//   edge_edge         u = a1 - a0, v = b1 - b0, w = b0 - a0
//   coplanarity       det(d0, d1, d2), det(u, v, w): zero when the four points lie in a plane
//   insides           2D areas (one component of a cross product), seen along a coordinate axis. In a contact they
//                     never have opposite signs; when the points are coplanar and all insides have the same strict
//                     sign, there is a contact. (vertex_face: the areas that 0 makes with the edges of the face.
//                     edge_edge: with c = u x v, the numerators of the parameters of the crossing point and of their
//                     complements.)
//
// Callers handle signs that are zero or unknown.
#pragma once

#include <array>
#include <cstddef>

namespace noli::formula {

template <class T, std::size_t N>
using Vec = std::array<T, N>;

/// A vector that moves linearly: s at_t0 + t at_t1.
template <class T, std::size_t N>
struct Moving {
  Vec<T, N> at_t0;
  Vec<T, N> at_t1;
};

/// Coefficients of a homogeneous polynomial of degree Degree in (s, t); see the notation above.
template <class T, std::size_t Degree>
using Form = std::array<T, Degree + 1>;

template <class T, std::size_t N>
constexpr Vec<T, N> operator-(const Vec<T, N>& a, const Vec<T, N>& b) {
  if constexpr (N == 2) {
    return {a[0] - b[0], a[1] - b[1]};
  } else {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
}

template <class T, std::size_t N>
constexpr Moving<T, N> operator-(const Moving<T, N>& a, const Moving<T, N>& b) {
  return {a.at_t0 - b.at_t0, a.at_t1 - b.at_t1};
}

/// Component `axis` of a x b, from the two components that follow it cyclically.
template <class T>
constexpr auto cross_component(const Vec<T, 3>& a, const Vec<T, 3>& b, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  return a[i] * b[j] - a[j] * b[i];
}

/// a x b.
template <class T>
constexpr auto cross(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  using Product = decltype(cross_component(a, b, 0));
  return Vec<Product, 3>{cross_component(a, b, 0), cross_component(a, b, 1), cross_component(a, b, 2)};
}

/// a x b of two vectors in the plane.
template <class T>
constexpr auto cross(const Vec<T, 2>& a, const Vec<T, 2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

template <class T, class U>
constexpr auto dot(const Vec<T, 3>& a, const Vec<U, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T, class U>
constexpr auto dot(const Vec<T, 2>& a, const Vec<U, 2>& b) {
  return a[0] * b[0] + a[1] * b[1];
}

/// Component `axis` of the cross product of two moving vectors, as a form.
template <class T>
constexpr auto cross_component(const Moving<T, 3>& a, const Moving<T, 3>& b, std::size_t axis) {
  using Product = decltype(cross_component(a.at_t0, b.at_t0, axis));
  return Form<Product, 2>{cross_component(a.at_t0, b.at_t0, axis),
                          cross_component(a.at_t0, b.at_t1, axis) + cross_component(a.at_t1, b.at_t0, axis),
                          cross_component(a.at_t1, b.at_t1, axis)};
}

/// Cross product of two moving vectors in the plane, as a form.
template <class T>
constexpr auto cross(const Moving<T, 2>& a, const Moving<T, 2>& b) {
  using Product = decltype(cross(a.at_t0, b.at_t0));
  return Form<Product, 2>{cross(a.at_t0, b.at_t0), cross(a.at_t0, b.at_t1) + cross(a.at_t1, b.at_t0),
                          cross(a.at_t1, b.at_t1)};
}

/// Scalar product of two moving vectors, as a form.
template <class T, std::size_t N>
constexpr auto dot(const Moving<T, N>& a, const Moving<T, N>& b) {
  using Product = decltype(dot(a.at_t0, b.at_t0));
  return Form<Product, 2>{dot(a.at_t0, b.at_t0), dot(a.at_t0, b.at_t1) + dot(a.at_t1, b.at_t0), dot(a.at_t1, b.at_t1)};
}

/// The three components of a cross product of two moving vectors.
template <class T>
using CrossForms = std::array<Form<T, 2>, 3>;

template <class T>
constexpr auto cross(const Moving<T, 3>& a, const Moving<T, 3>& b) {
  using Product = typename decltype(cross_component(a, b, 0))::value_type;
  return CrossForms<Product>{cross_component(a, b, 0), cross_component(a, b, 1), cross_component(a, b, 2)};
}

/// Scalar product of a moving vector with a cross product of two others: their determinant, as a form.
template <class T, class U>
constexpr auto triple(const Moving<T, 3>& a, const CrossForms<U>& c) {
  const auto at = [&c](std::size_t i) { return Vec<U, 3>{c[0][i], c[1][i], c[2][i]}; };
  using Product = decltype(dot(a.at_t0, at(0)));
  return Form<Product, 3>{dot(a.at_t0, at(0)), dot(a.at_t0, at(1)) + dot(a.at_t1, at(0)),
                          dot(a.at_t0, at(2)) + dot(a.at_t1, at(1)), dot(a.at_t1, at(2))};
}

template <class T, std::size_t N>
constexpr std::array<T, N> difference(const std::array<T, N>& a, const std::array<T, N>& b) {
  std::array<T, N> c = a;
  for (std::size_t i = 0; i < N; ++i) c[i] = c[i] - b[i];
  return c;
}

template <class T, std::size_t N>
constexpr std::array<T, N> sum(const std::array<T, N>& a, const std::array<T, N>& b) {
  std::array<T, N> c = a;
  for (std::size_t i = 0; i < N; ++i) c[i] = c[i] + b[i];
  return c;
}

/// The differences of a vertex_face query: d_i = f_i - v.
template <class T>
struct VertexFace {
  std::array<Moving<T, 3>, 3> d;

  static constexpr std::size_t insides_count = 3;
  constexpr auto coplanarity() const { return triple(d[2], cross(d[0], d[1])); }
  constexpr auto insides(std::size_t axis) const {
    return std::array{cross_component(d[0], d[1], axis), cross_component(d[1], d[2], axis),
                      cross_component(d[2], d[0], axis)};
  }
};

/// The differences of an edge_edge query: u = a1 - a0, v = b1 - b0, w = b0 - a0.
template <class T>
struct EdgeEdge {
  Moving<T, 3> u, v, w;

  static constexpr std::size_t insides_count = 4;
  constexpr auto coplanarity() const { return triple(w, cross(u, v)); }
  constexpr auto insides(std::size_t axis) const {
    const auto c = cross_component(u, v, axis), wu = cross_component(w, u, axis), wv = cross_component(w, v, axis);
    return std::array{wu, difference(c, wu), wv, difference(c, wv)};
  }
};

}  // namespace noli::formula
