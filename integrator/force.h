// SPDX-License-Identifier: Apache-2.0
//
// The concept of an elastic force, and the vectors of the dynamics.
//
// Notation
//   V          the potential of one force, a function of the positions of its N vertices
//   measure    s_j: an argument of the potential, unchanged by rigid motions (a length, a strain, an angle); V = V(s_1,
//              ..., s_M)
//
// A force is a small value type. Asynchronous Contact Mechanics (Harmon et al. 2009, section 3) gives every force a
// clock of its own. Clocks are separate (integrator/clocks.h), so that forces with one clock can be fired in a row.
//
// Contact is not a force in this sense: its layers act on pairs that come and go (integrator/contact.h).
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include <noli/mesh.h>
#include <noli/run.h>
#include "certificates/vector.h"

namespace noli::integrator {

using noli::force_kinds;
using noli::ForceKind;

/// A position, velocity, impulse, ... with Dim coordinates of type S (double; multiprecision numbers for audits). As in
/// forces, the number type comes first.
template <class S, int Dim>
using Vec = certificates::Vector<Dim, S>;

/// One vector for each of the N vertices that a force reads, in the order of its `vertices`.
template <class S, int Dim, std::size_t N>
using VertexVectors = std::array<Vec<S, Dim>, N>;

/// An elastic force on N = F::size vertices with M = F::measures measures. F::Scalar is its number type, F::dimension
/// the dimension of space.
///   f.vertices         std::array<VertexId, N>: different vertices, in the order of VertexVectors
///   f.gradient(x)      dV/dx_i for each vertex [N]: the force is its negative
///   f.energy(x)        V(x) [J]
///   f.measure_gradients(x)  ds_j/dx_i for each measure j, for damping
///   f.stiffness()      for each measure, an upper bound of the sum over k of |d2V/ds_j ds_k| at rest, to estimate
///                      steps
///   f.damping          b_j = damping * stiffness()[j]: the damping force is -b_j (ds_j/dt) grad s_j [s]
template <class F>
concept ElasticForce = requires(const F f, const VertexVectors<typename F::Scalar, F::dimension, F::size>& x) {
  { F::kind } -> std::convertible_to<ForceKind>;
  { f.vertices } -> std::convertible_to<std::array<VertexId, F::size>>;
  { f.gradient(x) } -> std::same_as<VertexVectors<typename F::Scalar, F::dimension, F::size>>;
  { f.energy(x) } -> std::same_as<typename F::Scalar>;
  {
    f.measure_gradients(x)
    } -> std::same_as<std::array<VertexVectors<typename F::Scalar, F::dimension, F::size>, F::measures>>;
  { f.stiffness() } -> std::same_as<std::array<typename F::Scalar, F::measures>>;
  { f.damping } -> std::convertible_to<typename F::Scalar>;
};

}  // namespace noli::integrator
