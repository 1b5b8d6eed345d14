// SPDX-License-Identifier: Apache-2.0
//
// Small vectors of the dynamics: Eigen's, without its vector instructions, so that the bits are those of the formulas.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace noli::integrator {

/// A position, velocity, impulse, ... with Dim coordinates of type S (double; multiprecision numbers for audits).
template <class S, int Dim>
using Vec = Eigen::Matrix<S, Dim, 1, Eigen::DontAlign>;

/// One vector for each of the N vertices that a force reads, in the order of its `vertices`.
template <class S, int Dim, std::size_t N>
using Stencil = std::array<Vec<S, Dim>, N>;

}  // namespace noli::integrator
