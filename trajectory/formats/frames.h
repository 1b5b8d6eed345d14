// SPDX-License-Identifier: Apache-2.0
//
// Frames as files of one each: which formats there are, how they are read, and whether two have the same mesh.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <noli/mesh.h>
#include "trajectory/formats/polygons.h"

namespace noli {

/// Reads a frame; the extension decides how (mesh_format). Throws InputError, also for other extensions.
Frame read_frame(const std::filesystem::path& path);

/// The same for the bytes of a file; `path` decides how to read them, and errors name it. `polygons`: the rule for
/// polygons, which are also listed there.
Frame parse_frame(std::string_view bytes, const std::filesystem::path& path, Polygons* polygons = nullptr);

/// Throws InputError when the meshes differ in vertex count or in any cell; the message names both files and the first
/// difference.
void require_same_mesh(const Mesh& expected, const std::filesystem::path& expected_path, const Mesh& found,
                       const std::filesystem::path& found_path);

/// Whether all z are equal (as numbers). If so in both frames of a step, even with different z, the step may be decided
/// in two dimensions. True for no positions.
bool all_z_equal(std::span<const Position> positions);

/// Whether all z of two frames are equal.
bool in_one_plane(std::span<const Position> a, std::span<const Position> b);

/// Throws InputError, about the file of b, for two frames that are not in one plane.
void require_one_plane(std::span<const Position> a, std::span<const Position> b, const std::string& name_b);

/// ".ply": in lower case.
std::string extension_of(const std::filesystem::path& path);

enum class MeshFormat { ply, obj, vtk };

/// Whether a file of this name is a frame, by its extension.
bool is_frame_name(const std::filesystem::path& path);

/// By the extension, in any case: .ply, .obj, .vtu, .vtp. Throws InputError for all others, with conversion_advice().
MeshFormat mesh_format(const std::filesystem::path& path);

/// How to make frames of a file by its extension (.h5 .abc .usd .stl .vtk .gz .glb .fbx and others), one
/// line; "" for extensions that are not known.
std::string conversion_advice(const std::filesystem::path& path);

}  // namespace noli
