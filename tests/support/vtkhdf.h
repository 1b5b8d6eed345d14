// SPDX-License-Identifier: Apache-2.0
//
// Writes frames as VTKHDF by the functions of HDF5: triangles that all steps share, one part.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace noli::test {

class VtkHdfFile {
 public:
  explicit VtkHdfFile(const std::filesystem::path& file)
      : file_(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {
    group("VTKHDF");
    attribute("VTKHDF", "Version", {2, 0});
    text("VTKHDF", "Type", "PolyData");
  }
  ~VtkHdfFile() { H5Fclose(file_); }
  VtkHdfFile(const VtkHdfFile&) = delete;
  VtkHdfFile& operator=(const VtkHdfFile&) = delete;

  void group(const char* name) const { H5Gclose(H5Gcreate2(file_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); }

  void attribute(const char* object, const char* name, const std::vector<std::int64_t>& values) const {
    const hsize_t size = values.size();
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t id =
        H5Acreate_by_name(file_, object, name, H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(id, H5T_NATIVE_INT64, values.data());
    H5Aclose(id);
    H5Sclose(space);
  }
  void text(const char* object, const char* name, const std::string& value) const {
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, value.size());
    const hid_t id = H5Acreate_by_name(file_, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(id, type, value.data());
    H5Aclose(id);
    H5Sclose(space);
    H5Tclose(type);
  }
  /// Numbers are stored as `type`.
  void array(const char* name, const std::vector<double>& values, const std::vector<hsize_t>& shape, hid_t type) const {
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t id = H5Dcreate2(file_, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(id);
    H5Sclose(space);
  }
  void counts(const char* name, const std::vector<double>& values) const {
    array(name, values, {values.size()}, H5T_STD_I64LE);
  }
  hid_t id() const { return file_; }

 private:
  hid_t file_;
};

/// A motion of `frames` frames; coordinates are stored as `type`.
inline void write_vtkhdf(const std::filesystem::path& path, const std::vector<double>& coordinates, std::size_t frames,
                         const std::vector<std::array<std::int64_t, 3>>& faces, hid_t type) {
  const VtkHdfFile file(path);
  const std::size_t vertices = coordinates.size() / 3 / frames;
  file.array("VTKHDF/Points", coordinates, {coordinates.size() / 3, 3}, type);
  file.counts("VTKHDF/NumberOfPoints", {static_cast<double>(vertices)});
  std::vector<double> corners, ends = {0};
  for (const auto& face : faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    ends.push_back(static_cast<double>(corners.size()));
  }
  file.group("VTKHDF/Polygons");
  file.counts("VTKHDF/Polygons/NumberOfCells", {static_cast<double>(faces.size())});
  file.counts("VTKHDF/Polygons/NumberOfConnectivityIds", {static_cast<double>(corners.size())});
  file.counts("VTKHDF/Polygons/Connectivity", corners);
  file.counts("VTKHDF/Polygons/Offsets", ends);
  file.group("VTKHDF/Steps");
  file.attribute("VTKHDF/Steps", "NSteps", {static_cast<std::int64_t>(frames)});
  std::vector<double> points, zeros(frames, 0), ones(frames, 1);
  for (std::size_t k = 0; k < frames; ++k) points.push_back(static_cast<double>(k * vertices));
  file.counts("VTKHDF/Steps/NumberOfParts", ones);
  file.counts("VTKHDF/Steps/PartOffsets", zeros);
  file.counts("VTKHDF/Steps/PointOffsets", points);
  const std::vector<double> columns(4 * frames, 0);
  file.array("VTKHDF/Steps/CellOffsets", columns, {frames, 4}, H5T_STD_I64LE);
  file.array("VTKHDF/Steps/ConnectivityIdOffsets", columns, {frames, 4}, H5T_STD_I64LE);
}

}  // namespace noli::test
