// SPDX-License-Identifier: Apache-2.0
//
// Summarises a mesh file for `noli info`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include <noli/mesh.h>

namespace noli {

struct BoundingBox {
  Position lower;
  Position upper;
};

struct FileInfo {
  std::string format;       ///< "PLY ASCII", "PLY binary little-endian", "PLY binary big-endian", "OBJ" or "VTK"
  std::string number_type;  ///< of the coordinates in the file: "float64", "float32", ..., "decimal" (OBJ); several
                            ///< joined by '/'
  std::size_t vertices = 0;
  std::size_t faces = 0;        ///< triangles, after polygons have been cut
  std::size_t mesh_edges = 0;   ///< different edges of faces, and loose edges
  std::size_t loose_edges = 0;  ///< those of mesh_edges that no face has
  std::size_t loose_points = 0;
  std::size_t unreferenced_vertices = 0;  ///< vertices that no cell refers to
  std::size_t degenerate_faces = 0;  ///< faces of exactly zero area: corners that repeat, coincide or are on one line
  std::size_t coincident_vertices = 0;  ///< vertices at exactly the position of one with a smaller index
  std::optional<BoundingBox> box;       ///< of all vertices; absent when there are none
  bool planar = false;                  ///< all z are equal
};

/// Reads a file of a mesh and summarises it. Throws InputError as read_frame does.
FileInfo describe_file(const std::filesystem::path& path);

/// The same for a frame in memory; format and number_type stay empty.
FileInfo describe_frame(const Frame& frame);

}  // namespace noli
