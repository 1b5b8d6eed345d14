// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/vtk/write_vtu.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "trajectory/blocks/bytes.h"
#include "trajectory/formats/vtk/vtk_cell_reader.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

/// The cells as VTK stores them: the vertices of all cells, where each cell ends, and its type.
struct VtkCells {
  std::vector<std::uint64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;

  template <class Vertices>
  void add(const Vertices& vertices, VtkCell type) {
    connectivity.insert(connectivity.end(), vertices.begin(), vertices.end());
    offsets.push_back(connectivity.size());
    types.push_back(static_cast<std::uint8_t>(type));
  }
};

VtkCells vtk_cells(const Mesh& mesh) {
  VtkCells cells;
  for (const auto& face : mesh.faces) cells.add(face, vtk_triangle);
  for (const auto& edge : mesh.edges) cells.add(edge, vtk_line);
  for (const VertexId point : mesh.points) cells.add(std::span(&point, 1), vtk_vertex);
  return cells;
}

/// Adds an array to the appended data: its length in bytes and its bytes, together in base64. Returns its XML element,
/// whose offset counts characters from the underscore.
template <class T>
std::string append_array(std::string& appended, std::string_view attributes, std::span<const T> values) {
  std::string bytes;
  put(bytes, std::uint64_t{values.size_bytes()});
  put_all(bytes, values);
  const std::size_t offset = appended.size();
  appended += base64(bytes);
  return fmt::format("        <DataArray {} format=\"appended\" offset=\"{}\"/>\n", attributes, offset);
}

}  // namespace

std::string format_vtu(const Frame& frame, const std::optional<CellData>& data) {
  const VtkCells cells = vtk_cells(frame.mesh);
  std::string appended;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n";
  text += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n      <Points>\n",
                      frame.positions.size(), cells.types.size());
  text +=
      append_array(appended, "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", coordinates(frame.positions));
  text += "      </Points>\n      <Cells>\n";
  text += append_array(appended, "type=\"Int64\" Name=\"connectivity\"",
                       std::span<const std::uint64_t>(cells.connectivity));
  text += append_array(appended, "type=\"Int64\" Name=\"offsets\"", std::span<const std::uint64_t>(cells.offsets));
  text += append_array(appended, "type=\"UInt8\" Name=\"types\"", std::span<const std::uint8_t>(cells.types));
  text += "      </Cells>\n";
  if (data) {
    text += fmt::format("      <CellData Scalars=\"{}\">\n", data->name);
    text += append_array(appended, fmt::format("type=\"UInt8\" Name=\"{}\"", data->name),
                         std::span<const std::uint8_t>(data->values));
    text += "      </CellData>\n";
  }
  text += "    </Piece>\n  </UnstructuredGrid>\n";
  return text + "  <AppendedData encoding=\"base64\">\n_" + appended + "\n  </AppendedData>\n</VTKFile>\n";
}

std::string format_pvd(std::span<const PvdEntry> entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const PvdEntry& entry : entries) {
    text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", entry.time,
                        escaped_markup(entry.file));
  }
  return text + "  </Collection>\n</VTKFile>\n";
}

void write_vtu(const std::filesystem::path& path, const Frame& frame, const std::optional<CellData>& data) {
  write_file(path, format_vtu(frame, data));
}

void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries) {
  write_file(path, format_pvd(entries));
}

}  // namespace noli
