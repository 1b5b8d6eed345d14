// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/run_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace noli {
namespace {

std::string coordinates(const Position& x) { return fmt::format("({:.17g}, {:.17g}, {:.17g})", x[0], x[1], x[2]); }

}  // namespace

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool same_bits(const Position& a, const Position& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

bool same_bits(std::span<const Position> a, std::span<const Position> b) {
  return std::ranges::equal(a, b, [](const Position& p, const Position& q) { return same_bits(p, q); });
}

bool cells_of_one_group(const Mesh& mesh, std::span<const std::uint16_t> groups) {
  const auto alike = [&](const auto& cell) {
    return std::all_of(cell.begin(), cell.end(), [&](VertexId v) { return groups[v] == groups[cell[0]]; });
  };
  return std::all_of(mesh.faces.begin(), mesh.faces.end(), alike) &&
         std::all_of(mesh.edges.begin(), mesh.edges.end(), alike);
}

std::vector<Position> positions_at_end(const WorldLines& lines) {
  std::vector<Position> all(lines.vertex_count());
  for (VertexId v = 0; v < all.size(); ++v) all[v] = lines.positions(v).back();
  return all;
}

std::uint64_t count_breakpoints(const WorldLines& lines) {
  std::uint64_t count = 0;
  for (VertexId v = 0; v < lines.vertex_count(); ++v) count += lines.times(v).size();
  return count;
}

std::string time_problem(const WindowEnd& before, double begin) {
  if (same_bits(before.time, begin)) return "";
  return fmt::format("the window begins at {:.17g}, but the one before ends at {:.17g}", begin, before.time);
}

std::string position_problem(const WindowEnd& before, const WorldLines& lines) {
  for (VertexId v = 0; v < lines.vertex_count(); ++v) {
    const Position &begin = lines.positions(v).front(), &end = before.positions[v];
    if (same_bits(begin, end)) continue;
    return fmt::format("vertex {} begins at {}, but the window before left it at {}", v, coordinates(begin),
                       coordinates(end));
  }
  return "";
}

std::string frames_problem(std::uint64_t index, double begin, const WindowEnd& end, std::span<const RunFrame> frames) {
  bool may_be_equal = index == 0;
  double before = begin;
  for (const RunFrame& frame : frames) {
    if (!(before < frame.time || (may_be_equal && before == frame.time)) || frame.time > end.time) {
      return fmt::format("a frame at {:.17g} in a window from {:.17g} to {:.17g}, after {:.17g}", frame.time, begin,
                         end.time, before);
    }
    const auto alike = [](const Position& a, const Position& b) { return same_bits(a, b); };
    if (frame.time == end.time && !std::ranges::equal(frame.positions, end.positions, alike)) {
      return "the frame at the window's end has other positions than the end";
    }
    before = frame.time;
    may_be_equal = false;
  }
  return "";
}

}  // namespace noli
