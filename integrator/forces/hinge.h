// SPDX-License-Identifier: Apache-2.0
//
// Bending of two triangles in space about their common edge: the hinge of Grinspun, Hirani, Desbrun, Schroeder,
// "Discrete Shells" (2003), with a function of the angle that needs no arc tangent.
//
// Notation
//   x0, x1    the common edge, e = x1 - x0, L = |e|; x2, x3 the opposite vertices, a = x2 - x0, b = x3 - x0
//   n1, n2    e x a and b x e, the triangles' normals; N1, N2 their squared lengths
//   theta     the measure: the angle from n1 to n2 about e, in (-pi, pi], zero if flat, negative if folded towards the
//             normals. cos theta = n1.n2 / sqrt(N1 N2); sin theta = -L n1.b / sqrt(N1 N2), because n1 x n2 = -(n1.b) e
//   V         K (1 - cos(theta - theta0)), see forces/angle.h
//   K         rigidity L0^2 / A0, A0 the sum of the areas, all at rest. In the terms of Discrete Shells this is
//             3 kb L0^2 / A0 with kb = rigidity / 3: then a regular mesh bent to a cylinder of curvature c has the
//             energy rigidity/2 c^2 per area, that of a plate of this flexural rigidity (derived; a test measures it)
// Gradients of theta: -L n1/N1 at x2, -L n2/N2 at x3. With the feet alpha = a.e/L^2, beta = b.e/L^2 of x2, x3 on the
// edge, alpha L n1/N1 + beta L n2/N2 at x1. At x0 the value that makes the sum zero.
//
// Two square roots and two divisions per event.
//
// The moment is greatest a right angle away from rest and weakens beyond. Without area there is no angle: if a triangle
// has none, there is no force, and the energy counts as K, the mean over all angles. A bent plate has the Poisson ratio
// of the mesh (-1/3 if equilateral; a hinge sees one curvature), not that of the material.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "integrator/force.h"
#include "integrator/forces/angle.h"

namespace noli::integrator {

/// Young th^3 / (12 (1 - nu^2)) [N m]: the rigidity of a plate against bending to a cylinder.
template <class S>
S flexural_rigidity(const S& young, const S& poisson, const S& thickness) {
  return young * thickness * thickness * thickness / (S(12) * (S(1) - poisson * poisson));
}

template <class S>
struct Hinge {
  using Scalar = S;
  static constexpr int dimension = 3;
  static constexpr std::size_t size = 4, measures = 1;
  static constexpr ForceKind kind = ForceKind::hinge;
  using X = VertexVectors<S, 3, size>;

  std::array<VertexId, size> vertices{};  ///< x0, x1: the edge; x2, x3: opposite
  S constant{};                           ///< K [J], not negative
  Angle<S> rest{};                        ///< theta0
  S damping{};                            ///< [s]

  /// rigidity: flexural, of the plate [N m]. Throws std::invalid_argument if rounding cannot tell the area of a
  /// triangle of the rest shape from zero, or it is not finite.
  static Hinge from_rest(const std::array<VertexId, size>& vertices, const X& rest, const S& rigidity,
                         const S& damping = S(0)) {
    const Vec<S, 3> e = rest[1] - rest[0];
    const S area = (twice_area(e, rest[2] - rest[0]) + twice_area(e, rest[3] - rest[0])) / S(2);
    const Fold fold = fold_of(rest);
    if (!fold.regular || !(area <= std::numeric_limits<S>::max())) throw_degenerate();
    return {vertices, rigidity * e.squaredNorm() / area, fold.theta, damping};
  }

  S energy(const X& x) const { return constant * one_minus_cosine(fold_of(x).theta - rest); }

  X gradient(const X& x) const {
    const Fold fold = fold_of(x);
    return angle_gradient(fold, constant * (fold.theta - rest).sine);
  }

  /// The gradient of theta.
  std::array<X, measures> measure_gradients(const X& x) const { return {angle_gradient(fold_of(x), S(1))}; }

  std::array<S, measures> stiffness() const { return {constant}; }

 private:
  struct Fold {
    Vec<S, 3> u1, u2;  ///< L n1/N1, L n2/N2
    S alpha, beta;
    Angle<S> theta;
    bool regular;
  };

  /// All zero if a triangle has no area, or one so small that its powers underflow.
  static Fold fold_of(const X& x) {
    using std::sqrt;
    const Vec<S, 3> e = x[1] - x[0], a = x[2] - x[0], b = x[3] - x[0];
    const Vec<S, 3> n1 = e.cross(a), n2 = b.cross(e);
    const S N1 = n1.squaredNorm(), N2 = n2.squaredNorm(), L2 = e.squaredNorm(), product = N1 * N2;
    if (product < std::numeric_limits<S>::min()) {
      return {Vec<S, 3>::Zero(), Vec<S, 3>::Zero(), S(0), S(0), {S(0), S(0)}, false};
    }
    const S L = sqrt(L2), inverse = S(1) / product, inverse_L2 = S(1) / L2, inverse_root = sqrt(product) * inverse;
    return {(L * N2 * inverse) * n1,
            (L * N1 * inverse) * n2,
            a.dot(e) * inverse_L2,
            b.dot(e) * inverse_L2,
            {n1.dot(n2) * inverse_root, -L * n1.dot(b) * inverse_root},
            true};
  }

  /// slope times the gradient of theta.
  static X angle_gradient(const Fold& fold, const S& slope) {
    const Vec<S, 3> p1 = slope * fold.u1, p2 = slope * fold.u2, g1 = fold.alpha * p1 + fold.beta * p2;
    return {p1 + p2 - g1, g1, -p1, -p2};
  }

  static S twice_area(const Vec<S, 3>& e, const Vec<S, 3>& a) {
    using std::sqrt;
    const S result = sqrt(e.cross(a).squaredNorm());
    if (!(result > S(8) * std::numeric_limits<S>::epsilon() * sqrt(e.squaredNorm() * a.squaredNorm()))) {
      throw_degenerate();
    }
    return result;
  }

  [[noreturn]] static void throw_degenerate() { throw std::invalid_argument("hinge: a triangle has no area at rest"); }
};

static_assert(ElasticForce<Hinge<double>>);

}  // namespace noli::integrator
