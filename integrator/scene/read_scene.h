// SPDX-License-Identifier: Apache-2.0
//
// Reads a Scene from a scene file. The schema (schemas/scene.json) defines the fields. What it cannot express is
// checked here: lengths of vectors against the dimension, references to bodies, times that ascend.
//
// Errors are InputError: "FILE: /bodies/0/material/density: expected a number greater than 0 [kg/m^3], found -1".
// Errors in the JSON syntax have line and column.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "integrator/scene/scene.h"

namespace noli::integrator {

/// A scene has a full form, and a short one, in which the fields under "short" replace those of the full form.
enum class Form : std::uint8_t { full, brief };

/// Reads a scene file, but not the meshes and frames that it names. Checks both forms, whichever is asked for. Errors
/// of the short form begin with "FILE: /short: ". Throws InputError.
Scene read_scene(const std::filesystem::path& path, Form form = Form::full);

/// The same for a text in memory; errors name `path`, and relative paths begin at its folder.
Scene parse_scene(std::string_view text, const std::filesystem::path& path, Form form = Form::full);

/// The paths of the meshes and frames that a scene names.
std::vector<std::filesystem::path> files_of(const Scene& scene);

}  // namespace noli::integrator
