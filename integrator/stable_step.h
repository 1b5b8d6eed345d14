// SPDX-License-Identifier: Apache-2.0
//
// Computes how long the steps of forces may be.
//
// Notation
//   m_i       mass of vertex i; infinite if pinned or scripted: such vertices do not count below
//   g_j,i     gradient at vertex i of measure j of a force, c_j its stiffness (force.h)
//   kappa_i   of a force at a vertex: sum over j of c_j |g_j,i| (sum over k of |g_j,k|) / m_i [1/s^2]
//   Omega_i   of a vertex: 2 sum over the forces of one kind at i of kappa_i
//   h         of a force: factor * 2 / sqrt(max over its vertices of Omega_i)
//   limit     h with factor 1
//   b         damping of a force [s]
//   c         its damping number, 2 b h / limit^2: h b times a bound on the greatest squared frequency of its kind
//
// In a shape without stress, sum kappa_i is a row of a Gershgorin bound on M^-1 Hess V, with norms for its blocks: the
// greatest squared frequency of all forces of the kind is at most the greatest sum. Verlet's step for them is stable up
// to 2 / frequency. The 2 in Omega leaves room for as much stiffness of other kinds at the vertex.
//
// Each measure is damped by an implicit step, which is stable whatever c is. But forces that share vertices are damped
// in turn, and all of them together are not a symmetric operator on the velocities, as the last ones count more. With c
// large it creates energy: a sheet of 12 x 12 cells that swings from two corners gains nothing up to c = 4, a hundredth
// of what swings at 8, and takes off at 30. So steps that Noli chooses have c <= 8.
//
// The bound is for the given shape, usually the start; stress and large strain add stiffness that it does not include.
// For resonance between steps see resonance.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "integrator/model.h"
#include "trajectory/stop.h"

namespace noli::integrator {

/// The greatest damping number of a step that Noli chooses.
constexpr double most_damping_number = 8;

/// c of a step. `limit`: 1 as the factor of stable_steps().
inline double damping_number(double damping, double step, double limit) { return 2 * damping * step / (limit * limit); }

/// Omega_i / 2 that one force adds to each of its vertices [1/s^2].
template <class F, class S, int Dim>
std::array<S, F::size> squared_frequencies(const F& force, const std::vector<Vec<S, Dim>>& x,
                                           const std::vector<S>& inverse_mass) {
  using std::sqrt;
  VertexVectors<S, Dim, F::size> at;
  for (std::size_t i = 0; i < F::size; ++i) at[i] = x[force.vertices[i]];
  const auto gradients = force.measure_gradients(at);
  const auto stiffness = force.stiffness();
  std::array<S, F::size> result{};
  for (std::size_t j = 0; j < F::measures; ++j) {
    std::array<S, F::size> norms;
    S sum(0);
    for (std::size_t i = 0; i < F::size; ++i) {
      norms[i] = sqrt(gradients[j][i].squaredNorm());
      if (inverse_mass[force.vertices[i]] != S(0)) sum += norms[i];
    }
    for (std::size_t i = 0; i < F::size; ++i) {
      result[i] += stiffness[j] * norms[i] * sum * inverse_mass[force.vertices[i]];
    }
  }
  return result;
}

/// A step for each force of a list [s]; infinite for forces that move nothing. x, inverse_mass: by vertex; inverse_mass
/// is 0 for pinned or scripted ones. `factor`: a safety factor; 1 gives the limits above which a scene is refused.
template <class F, class S, int Dim>
std::vector<double> stable_steps(const ForceList<F>& list, const std::vector<Vec<S, Dim>>& x,
                                 const std::vector<S>& inverse_mass, double factor = 0.5) {
  std::vector<S> half_omega(x.size(), S(0));
  for (const F& force : list.forces) {
    end_if_stopped();
    const auto kappa = squared_frequencies(force, x, inverse_mass);
    for (std::size_t i = 0; i < F::size; ++i) half_omega[force.vertices[i]] += kappa[i];
  }
  std::vector<double> steps;
  steps.reserve(list.forces.size());
  for (const F& force : list.forces) {
    S greatest(0);
    for (const VertexId i : force.vertices) greatest = std::max(greatest, half_omega[i]);
    steps.push_back(factor * 2 / std::sqrt(static_cast<double>(S(2) * greatest)));
  }
  return steps;
}

}  // namespace noli::integrator
