// SPDX-License-Identifier: Apache-2.0
//
// The fields of one body, one script: what read_scene.h says, part by part.
#pragma once

#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/field.h"

namespace noli::integrator {

/// `index`: place in the list of bodies, for the default name.
Body read_body(const Field& f, std::size_t index);
/// The number of the body that a field names.
std::size_t find_body(const Field& name, const std::vector<Body>& bodies);
/// A step, at most as long as a window; nothing if the field is not there.
std::optional<double> read_step(const Field& f, std::string_view name);
ScriptedVertices read_script(const Field& f, const std::vector<Body>& bodies);

}  // namespace noli::integrator
