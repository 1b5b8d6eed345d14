// SPDX-License-Identifier: Apache-2.0
//
// Bending of a polygon in the plane at a vertex, with a function of the angle that needs no arc tangent.
//
// Notation
//   x0, x1, x2   three vertices in a row; a = x1 - x0, b = x2 - x1
//   phi          the measure: the turning angle from a to b in (-pi, pi], positive to the left. cos phi = a.b /
//                (|a||b|), sin phi = a x b / (|a||b|)
//   V            K (1 - cos(phi - phi0)), see forces/angle.h
//   K            2 rigidity / (|a| + |b|) at rest: a curve of curvature c has the energy rigidity/2 c^2 per length
//   J            the quarter turn to the left, (vx, vy) -> (-vy, vx)
// Gradients of phi: J a/|a|^2 at x0, J b/|b|^2 at x2; at x1 the value that makes the sum zero.
//
// One square root and one division per event.
//
// The moment is greatest a right angle away from rest and weakens beyond. If two neighbours coincide there is no angle:
// there is no force, and the energy counts as K, the mean over all angles.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>

#include "integrator/force.h"
#include "integrator/forces/angle.h"

namespace noli::integrator {

template <class S>
struct Turning {
  using Scalar = S;
  static constexpr int dimension = 2;
  static constexpr std::size_t size = 3, measures = 1;
  static constexpr ForceKind kind = ForceKind::turning;
  using X = VertexVectors<S, 2, size>;

  std::array<VertexId, size> vertices{};
  S constant{};     ///< K [J], not negative
  Angle<S> rest{};  ///< phi0
  S damping{};      ///< [s]

  /// rigidity: flexural, Young's modulus times the second moment of area [N m^2]. Throws std::invalid_argument if
  /// neighbours coincide at rest, or a length is not finite.
  static Turning from_rest(const std::array<VertexId, size>& vertices, const X& rest, const S& rigidity,
                           const S& damping = S(0)) {
    using std::sqrt;
    const Turn turn = turn_of(rest);
    const Vec<S, 2> a = rest[1] - rest[0], b = rest[2] - rest[1];
    const S length = (sqrt(a.squaredNorm()) + sqrt(b.squaredNorm())) / S(2);
    if (!turn.regular || !(length <= std::numeric_limits<S>::max())) {
      throw std::invalid_argument("turning: neighbours coincide at rest");
    }
    return {vertices, rigidity / length, turn.phi, damping};
  }

  S energy(const X& x) const { return constant * one_minus_cosine(turn_of(x).phi - rest); }

  X gradient(const X& x) const {
    const Turn turn = turn_of(x);
    return angle_gradient(turn, constant * (turn.phi - rest).sine);
  }

  /// The gradient of phi.
  std::array<X, measures> measure_gradients(const X& x) const { return {angle_gradient(turn_of(x), S(1))}; }

  std::array<S, measures> stiffness() const { return {constant}; }

 private:
  struct Turn {
    Vec<S, 2> ua, ub;  ///< J a/|a|^2, J b/|b|^2
    Angle<S> phi;
    bool regular;
  };

  /// All zero if neighbours coincide, or are so near that the powers of their distance underflow.
  static Turn turn_of(const X& x) {
    using std::sqrt;
    const Vec<S, 2> a = x[1] - x[0], b = x[2] - x[1];
    const S A = a.squaredNorm(), B = b.squaredNorm(), product = A * B;
    if (product < std::numeric_limits<S>::min()) {
      return {Vec<S, 2>::Zero(), Vec<S, 2>::Zero(), {S(0), S(0)}, false};
    }
    const S inverse = S(1) / product, inverse_root = sqrt(product) * inverse;
    const Vec<S, 2> Ja(-a[1], a[0]), Jb(-b[1], b[0]);
    return {(B * inverse) * Ja, (A * inverse) * Jb, {a.dot(b) * inverse_root, Ja.dot(b) * inverse_root}, true};
  }

  /// slope times the gradient of phi.
  static X angle_gradient(const Turn& turn, const S& slope) {
    const Vec<S, 2> g0 = slope * turn.ua, g2 = slope * turn.ub;
    return {g0, -(g0 + g2), g2};
  }
};

static_assert(ElasticForce<Turning<double>>);

}  // namespace noli::integrator
