// SPDX-License-Identifier: Apache-2.0
//
// The distance of two moving features, as a minimum over pairs of their faces (corners, edges, interior).
//
// Notation
//   part              a pair of faces, one of each feature: vertex and vertex, vertex and line, vertex and plane, line
//                     and line
//   positive          > 0 when the part is not degenerate
//   inside            all >= 0 when the nearest points of the two flats belong to the faces
//   excess            has the sign of (distance of the flats - eta), given that the part is not degenerate
// All are polynomials in t of degree at most 6. The features are within eta of each other iff some part is not
// degenerate, inside, and has no excess: a degenerate face is the union of its edges, and parallel edges are nearest to
// each other at an end.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <noli/query.h>
#include "kernel/arithmetic/polynomial.h"
#include "kernel/formula.h"

namespace noli::distance {

template <int Dim>
using Vector = formula::Vec<Polynomial, Dim>;
using formula::cross;
using formula::operator-;

struct Part {
  Polynomial positive;
  std::vector<Polynomial> inside;
  Polynomial excess;

  template <class Time>
  bool within(const Time& time) const {
    return time.sign(positive) > 0 &&
           std::ranges::all_of(inside, [&time](const Polynomial& p) { return time.sign(p) >= 0; }) &&
           time.sign(excess) <= 0;
  }
};

inline Polynomial constant(const Integer& x) { return Polynomial(std::vector<Integer>{x}); }

/// |a x b|^2.
inline Polynomial cross_square(const Vector<3>& a, const Vector<3>& b) {
  const Vector<3> c = cross(a, b);
  return formula::dot(c, c);
}
inline Polynomial cross_square(const Vector<2>& a, const Vector<2>& b) {
  const Polynomial c = cross(a, b);
  return c * c;
}

/// Parts of two features, given eta^2 in the units of the points.
template <int Dim>
class Parts {
 public:
  explicit Parts(const Integer& eta_squared) : eta_squared_(constant(eta_squared)) {}

  void vertex_vertex(const Vector<Dim>& d) {
    parts_.push_back({constant(Integer(1)), {}, formula::dot(d, d) - eta_squared_});
  }

  /// A vertex and the edge e0 e1, without its ends.
  void vertex_edge(const Vector<Dim>& v, const Vector<Dim>& e0, const Vector<Dim>& e1) {
    const Vector<Dim> p = v - e0, e = e1 - e0;
    const Polynomial along = formula::dot(p, e), length = formula::dot(e, e);
    Polynomial excess = cross_square(p, e) - eta_squared_ * length;
    parts_.push_back({length, {along, length - along}, std::move(excess)});
  }

  /// A vertex and the face, without its edges.
  void vertex_face(const Vector<3>& v, const Vector<3>& f0, const Vector<3>& f1, const Vector<3>& f2) {
    const Vector<3> d0 = f0 - v, d1 = f1 - v, d2 = f2 - v, n = cross(f1 - f0, f2 - f0);
    add_flat(n, {formula::dot(n, cross(d0, d1)), formula::dot(n, cross(d1, d2)), formula::dot(n, cross(d2, d0))}, d0);
  }

  /// Two edges, without their ends.
  void edge_edge(const Vector<3>& a0, const Vector<3>& a1, const Vector<3>& b0, const Vector<3>& b1) {
    const Vector<3> u = a1 - a0, v = b1 - b0, w = b0 - a0, c = cross(u, v);
    const Polynomial whole = formula::dot(c, c), s = formula::dot(c, cross(w, v)), r = formula::dot(c, cross(w, u));
    add_flat(c, {s, whole - s, r, whole - r}, w);
  }

  const std::vector<Part>& parts() const { return parts_; }

 private:
  /// Flats with the common normal n, and a vector from one to the other.
  void add_flat(const Vector<3>& n, std::vector<Polynomial> inside, const Vector<3>& between) {
    const Polynomial square = formula::dot(n, n), height = formula::dot(n, between);
    parts_.push_back({square, std::move(inside), height * height - eta_squared_ * square});
  }

  Polynomial eta_squared_;
  std::vector<Part> parts_;
};

/// All parts of the pair of features whose points are x.
template <FeaturePair Pair, int Dim, std::size_t N>
std::vector<Part> parts_of(const std::array<Vector<Dim>, N>& x, const Integer& eta_squared) {
  Parts<Dim> parts(eta_squared);
  constexpr std::size_t first = first_size(Pair);
  for (std::size_t i = 0; i < first; ++i) {
    for (std::size_t j = first; j < N; ++j) parts.vertex_vertex(x[i] - x[j]);
  }
  if constexpr (Pair == FeaturePair::vertex_edge) {
    parts.vertex_edge(x[0], x[1], x[2]);
  } else if constexpr (Pair == FeaturePair::vertex_face) {
    for (std::size_t j = 1; j < 4; ++j) parts.vertex_edge(x[0], x[j], x[1 + j % 3]);
    parts.vertex_face(x[0], x[1], x[2], x[3]);
  } else if constexpr (Pair == FeaturePair::edge_edge) {
    for (const std::size_t i : {0u, 1u}) parts.vertex_edge(x[i], x[2], x[3]);
    for (const std::size_t j : {2u, 3u}) parts.vertex_edge(x[j], x[0], x[1]);
    parts.edge_edge(x[0], x[1], x[2], x[3]);
  }
  return parts.parts();
}

}  // namespace noli::distance
