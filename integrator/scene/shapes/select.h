// SPDX-License-Identifier: Apache-2.0
//
// Which vertices of a body a selection means.
#pragma once

#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/field.h"
#include "integrator/scene/shapes/shape.h"

namespace noli::integrator {

/// Vertices by their numbers in the body, ascending, each once. Boxes choose among the start positions. `at` is the
/// selection's field. Throws InputError: a vertex or a set that is not there, a box without vertices.
std::vector<VertexId> select(const Selection& selection, const Shape& shape, const std::vector<Position>& start,
                             const Field& at);

/// Closed.
bool contains(const Box& box, const Position& x);

}  // namespace noli::integrator
