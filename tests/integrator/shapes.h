// SPDX-License-Identifier: Apache-2.0
//
// Generates random forces with their rest shapes, and shapes to test them in.
#pragma once

#include <algorithm>

#include "integrator/model.h"
#include "tests/kernel/random_numbers.h"

namespace noli::test {

/// The number of shapes tested for each force.
inline constexpr int shape_count = 100;

/// Random positions with coordinates in [-reach, reach).
template <std::size_t N, int Dim>
integrator::VertexVectors<double, Dim, N> random_stencil(Random& random, double reach) {
  integrator::VertexVectors<double, Dim, N> x;
  for (auto& point : x) {
    for (int d = 0; d < Dim; ++d) point[d] = reach * (2 * random.unit() - 1);
  }
  return x;
}

/// The greatest coordinate.
template <class S, int Dim, std::size_t N>
S greatest(const integrator::VertexVectors<S, Dim, N>& x) {
  S result(0);
  for (const auto& point : x) result = std::max(result, S(point.cwiseAbs().maxCoeff()));
  return result;
}

template <class F>
F random_force(Random& random);

template <>
inline integrator::EdgeSpring<double, 3> random_force(Random& random) {
  return {{0, 1}, 3, 0.5 + random.unit(), 0.1};
}

template <>
inline integrator::EdgeSpring<double, 2> random_force(Random& random) {
  return {{0, 1}, 3, 0.5 + random.unit(), 0.1};
}

template <>
inline integrator::Membrane<double> random_force(Random& random) {
  const double poisson = random.below(2) == 0 ? 0.3 : -0.3;
  return integrator::Membrane<double>::from_rest({0, 1, 2}, random_stencil<3, 3>(random, 1), {1000, poisson, 0.01},
                                                 0.1);
}

template <>
inline integrator::Hinge<double> random_force(Random& random) {
  return integrator::Hinge<double>::from_rest({0, 1, 2, 3}, random_stencil<4, 3>(random, 1), 2, 0.1);
}

template <>
inline integrator::Turning<double> random_force(Random& random) {
  return integrator::Turning<double>::from_rest({0, 1, 2}, random_stencil<3, 2>(random, 1), 2, 0.1);
}

/// The same force in another number type. Angles are recomputed, so that cosine and sine match in that type too.
template <class S>
integrator::Angle<S> convert(const integrator::Angle<double>& a) {
  using std::sqrt;
  const S c(a.cosine), s(a.sine), length = sqrt(S(c * c + s * s));
  return {c / length, s / length};
}

template <class S, int Dim>
integrator::EdgeSpring<S, Dim> convert(const integrator::EdgeSpring<double, Dim>& f) {
  return {f.vertices, S(f.constant), S(f.rest_length), S(f.damping)};
}

template <class S>
integrator::Membrane<S> convert(const integrator::Membrane<double>& f) {
  return {f.vertices, S(f.b11), S(f.b12), S(f.b22), S(f.shear), S(f.dilation), S(f.damping)};
}

template <class S>
integrator::Hinge<S> convert(const integrator::Hinge<double>& f) {
  return {f.vertices, S(f.constant), convert<S>(f.rest), S(f.damping)};
}

template <class S>
integrator::Turning<S> convert(const integrator::Turning<double>& f) {
  return {f.vertices, S(f.constant), convert<S>(f.rest), S(f.damping)};
}

}  // namespace noli::test
