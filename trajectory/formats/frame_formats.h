// SPDX-License-Identifier: Apache-2.0
//
// Which files are frames, and what to do with those that are not.
#pragma once

#include <filesystem>
#include <string>

namespace noli {

enum class MeshFormat { ply, obj };

/// By the extension, in any case. Throws InputError for all but .ply and .obj, with conversion_advice().
MeshFormat mesh_format(const std::filesystem::path& path);

/// How to make frames of a file by its extension (.npz .npy .abc .usd .stl .vtk .vtu .gz .glb .fbx and others), one
/// line; "" for extensions that are not known.
std::string conversion_advice(const std::filesystem::path& path);

}  // namespace noli
