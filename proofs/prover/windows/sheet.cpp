// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/sheet.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernel/static_predicates.h"

namespace noli {

namespace {

constexpr std::uint32_t nowhere = ~std::uint32_t{0};

/// For each vertex its edges to vertices with a higher number, in order: twice the other's number, plus 1 if the edge
/// comes from there.
struct Edges {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint64_t> ends;
};

template <class Visit>
void for_edges(std::span<const LocalFace> faces, const Visit& visit) {
  for (const LocalFace& f : faces) {
    for (std::size_t i = 0; i < 3; ++i) visit(f[i], f[i == 2 ? 0 : i + 1]);
  }
}

Edges edges_of(std::span<const LocalFace> faces, std::size_t vertices) {
  Edges edges{std::vector<std::uint32_t>(vertices + 1, 0), std::vector<std::uint64_t>(3 * faces.size())};
  for_edges(faces, [&](std::uint32_t a, std::uint32_t b) { ++edges.begin[std::min(a, b) + 1]; });
  std::partial_sum(edges.begin.begin(), edges.begin.end(), edges.begin.begin());
  std::vector<std::uint32_t> next(edges.begin.begin(), edges.begin.end() - 1);
  for_edges(faces, [&](std::uint32_t a, std::uint32_t b) {
    edges.ends[next[std::min(a, b)]++] = std::uint64_t{std::max(a, b)} << 1 | (a < b ? 0 : 1);
  });
  for (std::size_t v = 0; v < vertices; ++v) {
    std::sort(edges.ends.begin() + edges.begin[v], edges.ends.begin() + edges.begin[v + 1]);
  }
  return edges;
}

/// For each vertex the next one on the border, or `nowhere` if it is not on the border. Empty if (2) does not hold or
/// two edges of the border leave one vertex.
std::vector<std::uint32_t> border_edges(const Edges& edges) {
  const auto vertices = static_cast<std::uint32_t>(edges.begin.size() - 1);
  std::vector<std::uint32_t> next(vertices, nowhere);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    for (std::size_t e = edges.begin[v]; e < edges.begin[v + 1]; ++e) {
      const auto is_next = [&](std::uint64_t end) { return e + 1 < edges.begin[v + 1] && edges.ends[e + 1] == end; };
      const auto w = static_cast<std::uint32_t>(edges.ends[e] >> 1);
      const bool from_v = (edges.ends[e] & 1) == 0;
      if (is_next(edges.ends[e])) return {};
      if (from_v && is_next(edges.ends[e] + 1)) {
        ++e;
        if (is_next(edges.ends[e])) return {};
      } else if (std::uint32_t& to = next[from_v ? v : w]; to == nowhere) {
        to = from_v ? w : v;
      } else {
        return {};
      }
    }
  }
  return next;
}

/// Edges of a polygon ascend or descend (lexicographically). A polygon that turns left throughout turns around once iff
/// its edges ascend once and descend once.
bool turns_left_once(std::span<const std::uint32_t> border, std::span<const Point2> r) {
  const std::size_t n = border.size();
  const auto ascends = [&](std::size_t i) { return r[border[i % n]] < r[border[(i + 1) % n]]; };
  std::size_t tops = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const int turn = orientation(r[border[i]], r[border[(i + 1) % n]], r[border[(i + 2) % n]]);
    if (turn < 0 || (turn == 0 && ascends(i) != ascends(i + 1))) return false;
    if (ascends(i) && !ascends(i + 1)) ++tops;
  }
  return tops == 1;
}

}  // namespace

std::vector<std::uint32_t> border_of(std::span<const LocalFace> faces, std::size_t vertices) {
  const std::vector<std::uint32_t> next = border_edges(edges_of(faces, vertices));
  const auto on_border = [](std::uint32_t to) { return to != nowhere; };
  const auto first = std::find_if(next.begin(), next.end(), on_border);
  if (first == next.end()) return {};
  const auto start = static_cast<std::uint32_t>(first - next.begin());
  const auto count = static_cast<std::size_t>(std::count_if(next.begin(), next.end(), on_border));
  std::vector<std::uint32_t> border;
  std::uint32_t v = start;
  do {
    border.push_back(v);
    v = next[v];
  } while (v != start && v != nowhere && border.size() < count);
  if (v != start || border.size() != count) border.clear();
  return border;
}

bool is_sheet(std::span<const LocalFace> faces, std::span<const Point2> layout) {
  if (!std::ranges::all_of(layout, [](const Point2& p) { return std::isfinite(p[0] + p[1]); })) return false;
  const std::vector<std::uint32_t> border = border_of(faces, layout.size());
  return border.size() >= 3 && turns_left_once(border, layout) &&
         std::all_of(faces.begin(), faces.end(),
                     [&](const LocalFace& f) { return orientation(layout[f[0]], layout[f[1]], layout[f[2]]) > 0; });
}

}  // namespace noli
