// SPDX-License-Identifier: Apache-2.0
//
// Small scenes for tests, and edits of them.
#pragma once

#include <string>
#include <vector>

#include "integrator/scene/read_scene.h"

namespace noli::integrator::testing {

/// The least scene in space: an elastic grid of 2 x 2 cells, 1 m wide.
Json sheet();
/// The least scene in the plane: a ring of 8 springs.
Json loop();
/// A sheet with a patch, pins, a script, and all that gives it another shape and motion at the start.
Json scripted();
/// A scene with a value at a JSON pointer set, or removed.
Json changed(Json scene, const std::string& pointer, const Json& value);
Json without(Json scene, const std::string& pointer);
/// What parse_scene has to say against a scene that is called s.json; "" if nothing.
std::string problem_of(const Json& scene, Form form = Form::full);
/// Together they have each field of the schema, with a value that is not its default.
std::vector<Json> scenes_with_every_field();
/// Whether two scenes say the same, however their documents say it.
bool same(const Scene& a, const Scene& b);

}  // namespace noli::integrator::testing
