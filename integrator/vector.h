// SPDX-License-Identifier: Apache-2.0
//
// Small vectors of the dynamics: those of the certificates, with the number type as the first parameter, as in forces.
#pragma once

#include <array>
#include <cstddef>

#include "certificates/vector.h"

namespace noli::integrator {

/// A position, velocity, impulse, ... with Dim coordinates of type S (double; multiprecision numbers for audits).
template <class S, int Dim>
using Vec = certificates::Vector<Dim, S>;

/// One vector for each of the N vertices that a force reads, in the order of its `vertices`.
template <class S, int Dim, std::size_t N>
using VertexVectors = std::array<Vec<S, Dim>, N>;

}  // namespace noli::integrator
