// SPDX-License-Identifier: Apache-2.0
//
// Writes PLY files that ply.h reads back bit for bit.
//
// Coordinates are doubles, in ASCII with 17 significant digits. Loose edges are the element edge; loose points are
// faces of one vertex, after all others, which is how ply.h reads them.
#pragma once

#include <filesystem>
#include <string>

#include <noli/mesh.h>

namespace noli {

enum class PlyEncoding { ascii, binary_little_endian };

/// The bytes of the file. Precondition: as many positions as vertices; finite. The mesh is read back equal only if it
/// has no redundant cells (trajectory/cells.h).
std::string format_ply(const Frame& frame, PlyEncoding encoding);

/// Creates or replaces the file. Throws std::system_error when it cannot be written in full.
void write_ply(const std::filesystem::path& path, const Frame& frame, PlyEncoding encoding);

}  // namespace noli
