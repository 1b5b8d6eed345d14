// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/write_vtu.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <string_view>
#include <vector>

#include "trajectory/blocks/bytes.h"
#include "trajectory/formats/base64.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

/// The cells as VTK has them: the vertices of all, where each ends, and of what type it is.
struct VtkCells {
  std::vector<std::uint64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;

  template <class Vertices>
  void add(const Vertices& vertices, std::uint8_t type) {
    connectivity.insert(connectivity.end(), vertices.begin(), vertices.end());
    offsets.push_back(connectivity.size());
    types.push_back(type);
  }
};

VtkCells vtk_cells(const Mesh& mesh) {
  VtkCells cells;
  for (const auto& face : mesh.faces) cells.add(face, 5);
  for (const auto& edge : mesh.edges) cells.add(edge, 3);
  for (const VertexId point : mesh.points) cells.add(std::span(&point, 1), 1);
  return cells;
}

/// Numbers between the tags of their array.
class AsciiArrays {
 public:
  template <class T>
  std::string element(std::string_view attributes, std::span<const T> values, std::size_t per_line) {
    std::string text = fmt::format("        <DataArray {} format=\"ascii\">\n", attributes);
    for (std::size_t i = 0; i < values.size(); ++i) {
      fmt::format_to(std::back_inserter(text), std::is_same_v<T, double> ? "{:.17g}" : "{}", values[i]);
      text += (i + 1) % per_line == 0 || i + 1 == values.size() ? '\n' : ' ';
    }
    return text + "        </DataArray>\n";
  }
  std::string appended() const { return ""; }
};

/// Numbers at the end of the file, each array as its length in bytes and its bytes, in base64 together; `offset` counts
/// characters from the underscore.
class AppendedArrays {
 public:
  template <class T>
  std::string element(std::string_view attributes, std::span<const T> values, std::size_t) {
    std::string bytes;
    put(bytes, std::uint64_t{values.size_bytes()});
    put_all(bytes, values);
    const std::size_t offset = text_.size();
    text_ += base64(bytes);
    return fmt::format("        <DataArray {} format=\"appended\" offset=\"{}\"/>\n", attributes, offset);
  }
  std::string appended() const {
    return fmt::format("  <AppendedData encoding=\"base64\">\n_{}\n  </AppendedData>\n", text_);
  }

 private:
  std::string text_;
};

std::span<const double> coordinates(const std::vector<Position>& positions) {
  return {positions.empty() ? nullptr : positions.front().data(), 3 * positions.size()};
}

template <class Arrays>
std::string format_grid(const Frame& frame, Arrays written) {
  const VtkCells cells = vtk_cells(frame.mesh);
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n";
  text += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n      <Points>\n",
                      frame.positions.size(), cells.types.size());
  text += written.element("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", coordinates(frame.positions), 3);
  text += "      </Points>\n      <Cells>\n";
  text +=
      written.element("type=\"Int64\" Name=\"connectivity\"", std::span<const std::uint64_t>(cells.connectivity), 12);
  text += written.element("type=\"Int64\" Name=\"offsets\"", std::span<const std::uint64_t>(cells.offsets), 12);
  text += written.element("type=\"UInt8\" Name=\"types\"", std::span<const std::uint8_t>(cells.types), 24);
  return text + "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n" + written.appended() + "</VTKFile>\n";
}

}  // namespace

std::string format_vtu(const Frame& frame, VtuEncoding encoding) {
  return encoding == VtuEncoding::ascii ? format_grid(frame, AsciiArrays()) : format_grid(frame, AppendedArrays());
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

void write_vtu(const std::filesystem::path& path, const Frame& frame, VtuEncoding encoding) {
  write_file(path, format_vtu(frame, encoding));
}

void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries) {
  write_file(path, format_pvd(entries));
}

}  // namespace noli
