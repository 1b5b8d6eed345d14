// SPDX-License-Identifier: Apache-2.0
//
// Converts numpy arrays to Noli's types and back. Callers hold the interpreter's lock (GIL), except where a function
// says otherwise.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli::python {

/// Positions in an array (..., vertices, 2 or 3) of float32 or float64 in the machine's byte order, with any strides.
class PositionArray {
 public:
  /// Keeps the array. Precondition: its type and shape.
  explicit PositionArray(pybind11::array array);

  /// Copies one frame; two coordinates get z = 0. Needs no lock.
  std::vector<Position> frame(std::size_t k) const;

 private:
  pybind11::array array_;
  const char* data_;
  std::size_t vertices_ = 0;
  int coordinates_ = 3;
  bool single_ = false;
  pybind11::ssize_t frame_stride_ = 0, vertex_stride_ = 0, coordinate_stride_ = 0;
};

/// (vertices, 3), float64.
pybind11::array_t<double> array_of(const std::vector<Position>& positions);

/// Cells as rows of whole numbers, (n, Size).
template <std::size_t Size>
pybind11::array_t<std::int64_t> rows_of_cells(const std::vector<std::array<VertexId, Size>>& cells) {
  pybind11::array_t<std::int64_t> rows(
      {static_cast<pybind11::ssize_t>(cells.size()), static_cast<pybind11::ssize_t>(Size)});
  std::int64_t* place = rows.mutable_data();
  for (const auto& cell : cells) place = std::copy(cell.begin(), cell.end(), place);
  return rows;
}

/// A mesh of arrays (n, 3), (n, 2), (n) of int64, with any strides. Precondition: every index is below vertex_count.
Mesh mesh_of(std::size_t vertex_count, const pybind11::array_t<std::int64_t>& faces,
             const pybind11::array_t<std::int64_t>& edges, const pybind11::array_t<std::int64_t>& points);

/// An array that has the vector's numbers.
template <class Number>
pybind11::array_t<Number> array_of(const std::vector<Number>& numbers) {
  return pybind11::array_t<Number>(static_cast<pybind11::ssize_t>(numbers.size()), numbers.data());
}

}  // namespace noli::python
