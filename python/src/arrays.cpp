// SPDX-License-Identifier: Apache-2.0
#include "python/src/arrays.h"

#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace noli::python {
namespace {

namespace py = pybind11;

/// Rows of an index array. Precondition: two dimensions, `Size` columns.
template <std::size_t Size>
std::vector<std::array<VertexId, Size>> rows_of(const py::array_t<std::int64_t>& array) {
  const auto numbers = array.unchecked<2>();
  std::vector<std::array<VertexId, Size>> rows(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < Size; ++j) {
      rows[i][j] = static_cast<VertexId>(numbers(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(j)));
    }
  }
  return rows;
}

template <class Number>
double number_at(const char* place) {
  Number number;
  std::memcpy(&number, place, sizeof(number));
  return static_cast<double>(number);
}

}  // namespace

PositionArray::PositionArray(py::array array)
    : array_(std::move(array)), data_(static_cast<const char*>(array_.data())) {
  const auto dimensions = array_.ndim();
  const auto bytes = array_.itemsize();
  single_ = bytes == sizeof(float);
  const bool real = array_.dtype().kind() == 'f' && (single_ || bytes == sizeof(double));
  if (!real || dimensions < 2 || dimensions > 3) {
    throw std::logic_error("an array of positions of another type or shape");
  }
  if (dimensions == 3) {
    frame_stride_ = array_.strides(0);
  }
  vertices_ = static_cast<std::size_t>(array_.shape(dimensions - 2));
  vertex_stride_ = array_.strides(dimensions - 2);
  coordinates_ = static_cast<int>(array_.shape(dimensions - 1));
  coordinate_stride_ = array_.strides(dimensions - 1);
}

std::vector<Position> PositionArray::frame(std::size_t k) const {
  std::vector<Position> positions(vertices_, Position{});
  const char* row = data_ + static_cast<py::ssize_t>(k) * frame_stride_;
  for (Position& x : positions) {
    const char* place = row;
    for (int axis = 0; axis < coordinates_; ++axis) {
      x[static_cast<std::size_t>(axis)] = single_ ? number_at<float>(place) : number_at<double>(place);
      place += coordinate_stride_;
    }
    row += vertex_stride_;
  }
  return positions;
}

py::array_t<double> array_of(const std::vector<Position>& positions) {
  py::array_t<double> array({static_cast<py::ssize_t>(positions.size()), py::ssize_t{3}});
  std::memcpy(array.mutable_data(), positions.data(), positions.size() * sizeof(Position));
  return array;
}

Mesh mesh_of(std::size_t vertex_count, const py::array_t<std::int64_t>& faces, const py::array_t<std::int64_t>& edges,
             const py::array_t<std::int64_t>& points) {
  Mesh mesh;
  mesh.vertex_count = vertex_count;
  mesh.faces = rows_of<3>(faces);
  mesh.edges = rows_of<2>(edges);
  const auto numbers = points.unchecked<1>();
  for (py::ssize_t i = 0; i < points.shape(0); ++i) mesh.points.push_back(static_cast<VertexId>(numbers(i)));
  return mesh;
}

}  // namespace noli::python
