// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/write_obj.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>

#include "trajectory/write_file.h"

namespace noli {
namespace {

/// OBJ counts vertices from 1, so the number of the last of 2^32 does not fit a VertexId.
std::uint64_t number(VertexId v) { return std::uint64_t{v} + 1; }

}  // namespace

std::string format_obj(const Frame& frame) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const Position& x : frame.positions) fmt::format_to(out, "v {:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
  for (const auto& f : frame.mesh.faces) fmt::format_to(out, "f {} {} {}\n", number(f[0]), number(f[1]), number(f[2]));
  for (const auto& e : frame.mesh.edges) fmt::format_to(out, "l {} {}\n", number(e[0]), number(e[1]));
  for (const VertexId v : frame.mesh.points) fmt::format_to(out, "p {}\n", number(v));
  return text;
}

void write_obj(const std::filesystem::path& path, const Frame& frame) { write_file(path, format_obj(frame)); }

}  // namespace noli
