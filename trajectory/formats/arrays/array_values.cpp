// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/array_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <noli/errors.h>
#include "trajectory/cells.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

template <class Number>
std::vector<Number> numbers_of(ByteStream& bytes, const NpyHeader& header, const std::string& name) {
  if (!header.refusal.empty()) throw InputError(name, "", header.refusal);
  constexpr std::uint64_t most_at_once = std::uint64_t{1} << 20;
  std::vector<Number> numbers;
  for (std::uint64_t left = header.count(); left > 0;) {
    end_if_stopped();
    // At first little, then as much again as has come.
    const std::uint64_t part = std::min(left, std::clamp<std::uint64_t>(numbers.size(), 1024, most_at_once));
    const std::size_t before = numbers.size();
    numbers.resize(before + static_cast<std::size_t>(part));
    read_numbers(bytes, header, name, std::span(numbers).subspan(before));
    left -= part;
  }
  if (!header.fortran || header.shape.size() < 2) return numbers;
  const auto rows = static_cast<std::size_t>(header.shape[0]), columns = static_cast<std::size_t>(header.shape[1]);
  std::vector<Number> turned(numbers.size());
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < columns; ++k) turned[i * columns + k] = numbers[k * rows + i];
  }
  return turned;
}

}  // namespace

std::vector<std::int64_t> integers_of(ByteStream& bytes, const NpyHeader& header, const std::string& name) {
  return numbers_of<std::int64_t>(bytes, header, name);
}

std::vector<double> reals_of(ByteStream& bytes, const NpyHeader& header, const std::string& name) {
  return numbers_of<double>(bytes, header, name);
}

std::size_t corners_of(const NpyHeader& header) {
  return header.shape.size() == 1 ? 1 : static_cast<std::size_t>(header.shape[1]);
}

void append_cells(Mesh& mesh, std::span<const std::int64_t> vertices, std::size_t corners, const std::string& name) {
  std::array<VertexId, 3> cell{};
  for (std::size_t at = 0; at < vertices.size(); at += corners) {
    for (std::size_t k = 0; k < corners; ++k) {
      const std::int64_t v = vertices[at + k];
      if (v < 0 || static_cast<std::uint64_t>(v) >= mesh.vertex_count) {
        throw InputError(name, "",
                         fmt::format("cell {} has vertex {}; expected 0 to {}", at / corners, v,
                                     static_cast<std::int64_t>(mesh.vertex_count) - 1));
      }
      cell[k] = static_cast<VertexId>(v);
    }
    add_polygon(mesh, std::span<const VertexId>(cell).first(corners));
  }
}

std::vector<Position> positions_of(std::span<const double> numbers, std::size_t coordinates, const std::string& frame) {
  std::vector<Position> positions(numbers.size() / coordinates, Position{});
  for (std::size_t v = 0; v < positions.size(); ++v) {
    for (std::size_t c = 0; c < coordinates; ++c) {
      const double x = numbers[v * coordinates + c];
      if (!std::isfinite(x)) {
        throw InputError(frame, "", fmt::format("vertex {}: expected a finite coordinate, found {}", v, x));
      }
      positions[v][c] = x;
    }
  }
  return positions;
}

}  // namespace noli
