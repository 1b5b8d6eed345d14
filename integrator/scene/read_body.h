// SPDX-License-Identifier: Apache-2.0
//
// Reads the fields of one body or one script, for read_scene.h.
#pragma once

#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/field.h"

namespace noli::integrator {

/// `index`: of the body in the list, for its default name.
Body read_body(const Field& f, std::size_t index);
/// The number of the body that a field names.
std::size_t find_body(const Field& name, const std::vector<Body>& bodies);
/// A step, at most as long as a window; nothing if the field is absent.
std::optional<double> read_step(const Field& f, std::string_view name);
ScriptedVertices read_script(const Field& f, const std::vector<Body>& bodies);

}  // namespace noli::integrator
