// SPDX-License-Identifier: Apache-2.0
//
// Builds small scenes for tests, and edits them.
#pragma once

#include <string>
#include <vector>

#include "integrator/scene/read_scene.h"

namespace noli::integrator::testing {

/// A minimal scene in space: an elastic grid of 2 x 2 cells, 1 m wide.
Json sheet();
/// A minimal scene in the plane: a ring of 8 springs.
Json loop();
/// A sheet with a patch, pins, a script, and every option for its initial shape and motion.
Json scripted();
/// A scene with a value at a JSON pointer set, or removed.
Json changed(Json scene, const std::string& pointer, const Json& value);
Json without(Json scene, const std::string& pointer);
/// The error of parse_scene for a scene named s.json; "" if there is none.
std::string problem_of(const Json& scene, Form form = Form::full);
/// Scenes that together set each field of the schema to a value other than its default.
std::vector<Json> scenes_with_every_field();
/// Whether two scenes have the same values, regardless of how their documents express them.
bool same(const Scene& a, const Scene& b);

}  // namespace noli::integrator::testing
