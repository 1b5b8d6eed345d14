// SPDX-License-Identifier: Apache-2.0
//
// A spring along an edge. Notation: a, b its ends; L = |b - a|, L0 its rest length; V = k/2 (L - L0)^2.
//
// At L = 0 there is no direction, and the force is 0.
#pragma once

#include <cmath>

#include "integrator/force.h"

namespace noli::integrator {

template <class S, int Dim>
struct EdgeSpring {
  using Scalar = S;
  static constexpr int dimension = Dim;
  static constexpr std::size_t size = 2, measures = 1;
  static constexpr ForceKind kind = ForceKind::edge_spring;
  using X = VertexVectors<S, Dim, size>;

  std::array<VertexId, size> vertices{};
  S constant{};     ///< k [N/m], not negative
  S rest_length{};  ///< L0 [m], not negative
  S damping{};      ///< [s]

  S energy(const X& x) const {
    const S stretch = length(x[1] - x[0]) - rest_length;
    return S(0.5) * constant * stretch * stretch;
  }

  X gradient(const X& x) const {
    const Vec<S, Dim> edge = x[1] - x[0];
    const S l = length(edge);
    if (!(l > S(0))) return {Vec<S, Dim>::Zero(), Vec<S, Dim>::Zero()};
    const Vec<S, Dim> g = (constant * (l - rest_length) / l) * edge;
    return {-g, g};
  }

  std::array<X, measures> measure_gradients(const X& x) const {
    const Vec<S, Dim> edge = x[1] - x[0];
    const S l = length(edge);
    if (!(l > S(0))) return {X{Vec<S, Dim>::Zero(), Vec<S, Dim>::Zero()}};
    const Vec<S, Dim> t = edge / l;
    return {X{-t, t}};
  }

  std::array<S, measures> stiffness() const { return {constant}; }

 private:
  static S length(const Vec<S, Dim>& edge) {
    using std::sqrt;
    return sqrt(edge.squaredNorm());
  }
};

}  // namespace noli::integrator
