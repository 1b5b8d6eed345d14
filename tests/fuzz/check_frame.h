// SPDX-License-Identifier: Apache-2.0
//
// Checks what must hold for every frame that a reader accepts.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include <noli/errors.h>
#include "trajectory/cells.h"
#include "trajectory/formats/ply.h"
#include "trajectory/formats/write_ply.h"

namespace noli::fuzz {

/// Aborts, which the fuzzer reports as a finding.
inline void require(bool condition) {
  if (!condition) std::abort();
}

inline void check_indices(const Mesh& mesh) {
  const auto in_range = [&](VertexId v) { return v < mesh.vertex_count; };
  for (const auto& face : mesh.faces) require(std::all_of(face.begin(), face.end(), in_range));
  for (const auto& edge : mesh.edges) require(std::all_of(edge.begin(), edge.end(), in_range));
  require(std::all_of(mesh.points.begin(), mesh.points.end(), in_range));
}

inline void check_positions(const Frame& frame) {
  require(frame.positions.size() == frame.mesh.vertex_count);
  for (const Position& x : frame.positions) {
    require(std::all_of(x.begin(), x.end(), [](double c) { return std::isfinite(c); }));
  }
}

/// Requires that writing and reading the frame gives the same frame, bit for bit.
inline void check_round_trip(const Frame& frame, PlyEncoding encoding) {
  const Frame again = parse_ply(format_ply(frame, encoding), "written");
  require(again.mesh == frame.mesh);
  using Bits = std::array<std::uint64_t, 3>;
  require(std::equal(
      again.positions.begin(), again.positions.end(), frame.positions.begin(), frame.positions.end(),
      [](const Position& a, const Position& b) { return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b); }));
}

/// Calls `parse` on the input. It must return a valid frame, or throw an InputError of one line that begins with the
/// file's name.
template <class Parse>
int check_reader(const std::uint8_t* data, std::size_t size, Parse&& parse) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  Frame frame;
  try {
    frame = parse(bytes, "input");
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input: ") && message.find('\n') == std::string_view::npos);
    return 0;
  }
  check_indices(frame.mesh);
  check_positions(frame);
  check_round_trip(frame, PlyEncoding::ascii);
  check_round_trip(frame, PlyEncoding::binary_little_endian);
  return 0;
}

}  // namespace noli::fuzz
