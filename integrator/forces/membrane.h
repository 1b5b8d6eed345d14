// SPDX-License-Identifier: Apache-2.0
//
// In-plane stretching of a triangle in space: constant strain, St. Venant-Kirchhoff material, plane stress.
// The gradient is derived from V below.
//
// Notation
//   D        the 2 x 2 matrix whose columns are the rest edges X1 - X0, X2 - X0 in an orthonormal frame of the rest
//            plane whose first axis is along X1 - X0; so D and B = D^-1 are upper triangular
//   A0, th   rest area and thickness
//   F        the deformation gradient, 3 x 2: F = (x1 - x0, x2 - x0) B, columns f1, f2
//   E        Green strain (F^T F - I) / 2; the measures are E11, E22, E12 in the frame of the first rest edge
//   V        th A0 (mu (E11^2 + E22^2 + 2 E12^2) + lambda/2 (E11 + E22)^2), a quadratic form of the measures
//   mu, lambda   Young / (2 (1 + nu)), Young nu / (1 - nu^2): the second is that of plane stress
//
// Neither division nor square root per event.
//
// The material softens under strong compression and does not resist being turned inside out or crushed to a line (the
// formulas hold there, and the force is finite). It does not resist bending; forces/hinge.h does.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>

#include "integrator/force.h"

namespace noli::integrator {

/// A thin sheet of an isotropic material. Preconditions: young, thickness positive; -1 < poisson < 1.
template <class S>
struct SheetMaterial {
  S young{};      ///< [Pa]
  S poisson{};    ///< nu
  S thickness{};  ///< th [m]
};

template <class S>
struct Membrane {
  using Scalar = S;
  static constexpr int dimension = 3;
  static constexpr std::size_t size = 3, measures = 3;
  static constexpr ForceKind kind = ForceKind::membrane;
  using X = VertexVectors<S, 3, size>;

  std::array<VertexId, size> vertices{};
  S b11{}, b12{}, b22{};  ///< B [1/m]; b21 = 0
  S shear{};              ///< 2 mu th A0 [J]
  S dilation{};           ///< lambda th A0 [J]
  S damping{};            ///< [s]

  /// Throws std::invalid_argument if rounding cannot tell the area of the rest shape X from zero, or it is not finite.
  static Membrane from_rest(const std::array<VertexId, size>& vertices, const X& rest, const SheetMaterial<S>& material,
                            const S& damping = S(0)) {
    using std::sqrt;
    const Vec<S, 3> e1 = rest[1] - rest[0], e2 = rest[2] - rest[0];
    const S l1 = sqrt(e1.squaredNorm()), l2 = sqrt(e2.squaredNorm());
    if (!(l1 > S(0))) throw std::invalid_argument("membrane: a triangle has no area at rest");
    const S along = e1.dot(e2) / l1;
    const Vec<S, 3> across = e2 - (along / l1) * e1;
    const S height = sqrt(across.squaredNorm()), volume = material.thickness * l1 * height / S(2);
    if (!(height > S(8) * std::numeric_limits<S>::epsilon() * l2 && volume <= std::numeric_limits<S>::max())) {
      throw std::invalid_argument("membrane: a triangle has no area at rest");
    }
    const S mu = material.young / (S(2) * (S(1) + material.poisson));
    const S lambda = material.young * material.poisson / (S(1) - material.poisson * material.poisson);
    return {vertices, S(1) / l1, -along / (l1 * height), S(1) / height, S(2) * mu * volume, lambda * volume, damping};
  }

  S energy(const X& x) const {
    const Strain e = strain(columns(x));
    const S trace = e.e11 + e.e22;
    return S(0.5) * (shear * (e.e11 * e.e11 + e.e22 * e.e22 + S(2) * e.e12 * e.e12) + dilation * trace * trace);
  }

  X gradient(const X& x) const {
    const Columns f = columns(x);
    const Strain e = strain(f);
    const S pressure = dilation * (e.e11 + e.e22);
    const S s11 = shear * e.e11 + pressure, s22 = shear * e.e22 + pressure, s12 = shear * e.e12;
    const Vec<S, 3> h2 = s12 * f.f1 + s22 * f.f2;
    return balanced(b11 * (s11 * f.f1 + s12 * f.f2) + b12 * h2, b22 * h2);
  }

  /// The gradients of E11, E22, E12.
  std::array<X, measures> measure_gradients(const X& x) const {
    const Columns f = columns(x);
    const S half(0.5);
    return {balanced(b11 * f.f1, Vec<S, 3>::Zero()), balanced(b12 * f.f2, b22 * f.f2),
            balanced(half * (b11 * f.f2 + b12 * f.f1), (half * b22) * f.f1)};
  }

  std::array<S, measures> stiffness() const {
    const S normal = shear + dilation + (dilation < S(0) ? S(-dilation) : dilation);
    return {normal, normal, S(2) * shear};
  }

 private:
  struct Columns {
    Vec<S, 3> f1, f2;
  };
  struct Strain {
    S e11, e22, e12;
  };

  Columns columns(const X& x) const {
    const Vec<S, 3> e1 = x[1] - x[0], e2 = x[2] - x[0];
    return {b11 * e1, b12 * e1 + b22 * e2};
  }

  static Strain strain(const Columns& f) {
    const S half(0.5);
    return {half * (f.f1.squaredNorm() - S(1)), half * (f.f2.squaredNorm() - S(1)), half * f.f1.dot(f.f2)};
  }

  /// The gradient at vertex 0 makes the sum zero.
  static X balanced(const Vec<S, 3>& g1, const Vec<S, 3>& g2) { return {-(g1 + g2), g1, g2}; }
};

static_assert(ElasticForce<Membrane<double>>);

}  // namespace noli::integrator
