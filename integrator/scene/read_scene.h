// SPDX-License-Identifier: Apache-2.0
//
// From a scene file to a Scene. The schema (schemas/scene.json) says which fields there are; what it cannot say is
// checked here: lengths of vectors against the dimension, references to bodies, times that ascend.
//
// Errors are InputError: "FILE: /bodies/0/material/density: expected a number greater than 0 [kg/m^3], found -1". Text
// that is not JSON is named by line and column.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "integrator/scene/scene.h"

namespace noli::integrator {

/// A scene has a full form and a short one: that with what stands under "short" put in its place.
enum class Form : std::uint8_t { full, brief };

/// Reads a scene file. Meshes and frames it names are not read yet. Throws InputError.
Scene read_scene(const std::filesystem::path& path, Form form = Form::full);

/// The same for a text in memory; `path` is what errors call it, and where relative paths begin.
Scene parse_scene(std::string_view text, const std::filesystem::path& path, Form form = Form::full);

/// The meshes and frames that a scene names, where they are looked for.
std::vector<std::filesystem::path> files_of(const Scene& scene);

}  // namespace noli::integrator
