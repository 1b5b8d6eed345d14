// SPDX-License-Identifier: Apache-2.0
//
// Computes the positions of a body at rest and at the start. It uses only + - * / sqrt (angles: turn.h), so bits are
// the same on every machine.
//
// Notation
//   X    position at rest: scale * that of the mesh
//   x    position at the start: X deformed, rotated, moved; then perturbed
#pragma once

#include <utility>
#include <vector>

#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/shape.h"

namespace noli::integrator {

/// X and x of each vertex; x before it is perturbed.
std::pair<std::vector<Position>, std::vector<Position>> place(const Shape& shape, const Deform& deform,
                                                              const Transform& transform);

/// Adds to each coordinate (two in dimension 2) an amount drawn evenly from [-amplitude, amplitude). It depends on the
/// seed, the body's number, the vertex, and the coordinate.
void perturb(std::vector<Position>& positions, double amplitude, std::uint64_t seed, std::size_t body, int dimension);

}  // namespace noli::integrator
