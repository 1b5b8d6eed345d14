// SPDX-License-Identifier: Apache-2.0
//
// Writes VTK's XML files for ParaView: VTU, an unstructured grid for each frame, and PVD, which lists their times.
//
// Faces are triangles (cell type 5), loose edges lines (3), loose points vertices (1). Unreferenced vertices are points
// without a cell. Numbers are appended data in base64, so doubles keep all their bits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli {

/// A number for each cell; the name must not contain XML markup.
struct CellData {
  std::string name;
  std::vector<std::uint8_t> values;
};

/// The bytes of the file. Precondition: as many positions as vertices, and as many values as cells.
std::string format_vtu(const Frame& frame, const std::optional<CellData>& data = std::nullopt);

struct PvdEntry {
  double time = 0;   ///< seconds
  std::string file;  ///< as seen from the PVD file; UTF-8
};

std::string format_pvd(std::span<const PvdEntry> entries);

/// Create or replace the file. Throw std::system_error when it cannot be written in full.
void write_vtu(const std::filesystem::path& path, const Frame& frame,
               const std::optional<CellData>& data = std::nullopt);
void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries);

}  // namespace noli
