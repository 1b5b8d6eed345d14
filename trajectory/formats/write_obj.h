// SPDX-License-Identifier: Apache-2.0
//
// Writes OBJ files that obj.h reads back bit for bit: coordinates with 17 significant digits, faces as `f`, loose
// edges as `l`, loose points as `p`.
#pragma once

#include <filesystem>
#include <string>

#include <noli/mesh.h>

namespace noli {

/// The bytes of the file. Preconditions as for format_ply.
std::string format_obj(const Frame& frame);

/// Creates or replaces the file. Throws std::system_error when it cannot be written in full.
void write_obj(const std::filesystem::path& path, const Frame& frame);

}  // namespace noli
