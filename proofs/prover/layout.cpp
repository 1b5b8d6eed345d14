// SPDX-License-Identifier: Apache-2.0
#include "noli/proofs/prover/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "noli/kernel/static_predicates.h"

namespace noli {

namespace {

using Faces = std::vector<std::uint32_t>;
using Corners = std::array<VertexId, 3>;

/// Vertices in the order in which they come along the border.
using Loop = std::vector<VertexId>;

/// Disjoint sets of vertices.
class Union {
 public:
  explicit Union(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), VertexId{0}); }
  VertexId find(VertexId v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(VertexId a, VertexId b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<VertexId> parent_;
};

/// The faces of each part.
std::vector<Faces> parts_of(const Mesh& mesh) {
  Union sets(mesh.vertex_count);
  for (const auto& f : mesh.faces) {
    sets.join(f[0], f[1]);
    sets.join(f[0], f[2]);
  }
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> part_of(mesh.vertex_count, none);
  std::vector<Faces> parts;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    std::uint32_t& part = part_of[sets.find(mesh.faces[f][0])];
    if (part == none) {
      part = static_cast<std::uint32_t>(parts.size());
      parts.emplace_back();
    }
    parts[part].push_back(f);
  }
  return parts;
}

/// Lays out one part after another.
class Flattener {
 public:
  Flattener(const Mesh& mesh, std::span<const Position> x, int dimension, std::vector<Point2>& layout)
      : mesh_(mesh), x_(x), dimension_(dimension), r_(layout), place_(mesh.vertex_count, nowhere) {}

  /// Whether the part is a sheet; then the layout of its vertices is set.
  bool lay_out(const Faces& part) {
    list_vertices(part);
    project(part);
    const std::vector<Corners> oriented = orient(part);
    const Loop border = oriented.size() == part.size() ? find_border(oriented) : Loop();
    for (const VertexId v : vertices_) place_[v] = nowhere;
    if (border.size() < 3) return false;
    move_to_hull(border);
    for (const VertexId v : vertices_) bulge(r_[v]);
    return turns_left_once(border) && std::all_of(oriented.begin(), oriented.end(), [this](const Corners& c) {
             return orientation(r_[c[0]], r_[c[1]], r_[c[2]]) > 0;
           });
  }

 private:
  static constexpr std::uint32_t nowhere = ~std::uint32_t{0};

  /// Numbers the vertices of the part.
  void list_vertices(const Faces& part) {
    vertices_.clear();
    for (const std::uint32_t f : part) {
      for (const VertexId v : mesh_.faces[f]) {
        if (place_[v] != nowhere) continue;
        place_[v] = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back(v);
      }
    }
  }

  /// Half the sum of the absolute areas of the faces, seen along each axis.
  std::array<double, 3> areas(const Faces& part) const {
    std::array<double, 3> sum{};
    for (const std::uint32_t f : part) {
      const auto& [a, b, c] = mesh_.faces[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        sum[k] +=
            std::abs((x_[b][i] - x_[a][i]) * (x_[c][j] - x_[a][j]) - (x_[b][j] - x_[a][j]) * (x_[c][i] - x_[a][i]));
      }
    }
    return sum;
  }

  /// Seen along the axis along which it looks largest, scaled to [-1, 1].
  void project(const Faces& part) {
    std::size_t along = 2;
    if (dimension_ == 3) {
      const auto area = areas(part);
      along = static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t axis = (along + 1 + k) % 3;
      double low = x_[vertices_[0]][axis], high = low;
      for (const VertexId v : vertices_) {
        low = std::min(low, x_[v][axis]);
        high = std::max(high, x_[v][axis]);
      }
      const double middle = 0.5 * low + 0.5 * high, half = 0.5 * high - 0.5 * low;
      for (const VertexId v : vertices_) r_[v][k] = (x_[v][axis] - middle) / half;
    }
  }

  /// The faces as they are laid out counterclockwise; fewer if one is degenerate.
  std::vector<Corners> orient(const Faces& part) const {
    std::vector<Corners> oriented;
    oriented.reserve(part.size());
    for (const std::uint32_t f : part) {
      const auto& [a, b, c] = mesh_.faces[f];
      const bool finite = std::isfinite(r_[a][0] + r_[a][1] + r_[b][0] + r_[b][1] + r_[c][0] + r_[c][1]);
      const int side = finite ? orientation(r_[a], r_[b], r_[c]) : 0;
      if (side == 0) break;
      oriented.push_back(side > 0 ? Corners{a, b, c} : Corners{a, c, b});
    }
    return oriented;
  }

  /// For each vertex its edges to vertices of a higher number, in order: twice the other's number, and 1 more if the edge
  /// comes from there.
  struct Edges {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint64_t> ends;
  };

  Edges edges_of(const std::vector<Corners>& oriented) const {
    Edges edges{std::vector<std::uint32_t>(vertices_.size() + 1, 0), std::vector<std::uint64_t>(3 * oriented.size())};
    const auto for_edges = [&](const auto& visit) {
      for (const Corners& c : oriented) {
        for (std::size_t i = 0; i < 3; ++i) visit(place_[c[i]], place_[c[i == 2 ? 0 : i + 1]]);
      }
    };
    for_edges([&](std::uint32_t a, std::uint32_t b) { ++edges.begin[std::min(a, b) + 1]; });
    std::partial_sum(edges.begin.begin(), edges.begin.end(), edges.begin.begin());
    std::vector<std::uint32_t> next(edges.begin.begin(), edges.begin.end() - 1);
    for_edges([&](std::uint32_t a, std::uint32_t b) {
      edges.ends[next[std::min(a, b)]++] = std::uint64_t{std::max(a, b)} << 1 | (a < b ? 0 : 1);
    });
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      std::sort(edges.ends.begin() + edges.begin[v], edges.ends.begin() + edges.begin[v + 1]);
    }
    return edges;
  }

  /// For each vertex the next on the border, `nowhere` if it is not on it; nothing at all if an edge is there twice in
  /// one direction or two edges of the border leave one vertex.
  std::vector<std::uint32_t> border_edges(const Edges& edges) const {
    std::vector<std::uint32_t> next(vertices_.size(), nowhere);
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
      for (std::size_t e = edges.begin[v]; e < edges.begin[v + 1]; ++e) {
        const bool more = e + 1 < edges.begin[v + 1];
        if (more && edges.ends[e] == edges.ends[e + 1]) return {};
        const auto w = static_cast<std::uint32_t>(edges.ends[e] >> 1);
        const bool from_v = (edges.ends[e] & 1) == 0;
        if (more && edges.ends[e + 1] >> 1 == w) {
          ++e;
          if (e + 1 < edges.begin[v + 1] && edges.ends[e] == edges.ends[e + 1]) return {};
        } else if (std::uint32_t& to = next[from_v ? v : w]; to == nowhere) {
          to = from_v ? w : v;
        } else {
          return {};
        }
      }
    }
    return next;
  }

  /// The border, if it is one cycle; else nothing.
  Loop find_border(const std::vector<Corners>& oriented) const {
    const std::vector<std::uint32_t> next = border_edges(edges_of(oriented));
    const auto on_border = [](std::uint32_t to) { return to != nowhere; };
    const auto first = std::find_if(next.begin(), next.end(), on_border);
    if (first == next.end()) return {};
    const auto start = static_cast<std::uint32_t>(first - next.begin());
    const auto count = static_cast<std::size_t>(std::count_if(next.begin(), next.end(), on_border));
    Loop loop;
    std::uint32_t v = start;
    do {
      loop.push_back(vertices_[v]);
      v = next[v];
    } while (v != start && v != nowhere && loop.size() < count);
    return v == start && loop.size() == count ? loop : Loop();
  }

  /// The places in the border that are corners of its convex hull, ascending. (Andrew's chain, on places in the border.)
  std::vector<std::size_t> hull_of(const Loop& border) const {
    std::vector<std::size_t> order(border.size()), hull;
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto at = [&](std::size_t i) -> const Point2& { return r_[border[i]]; };
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return at(i) < at(j); });
    const auto chain = [&](auto first, auto last) {
      const std::size_t base = hull.size();
      for (auto i = first; i != last; ++i) {
        while (hull.size() >= base + 2 && orientation(at(hull[hull.size() - 2]), at(hull.back()), at(*i)) <= 0) {
          hull.pop_back();
        }
        hull.push_back(*i);
      }
      hull.pop_back();
    };
    chain(order.begin(), order.end());
    chain(order.rbegin(), order.rend());
    std::sort(hull.begin(), hull.end());
    return hull;
  }

  /// Moves what is on the border between two corners of the hull to the straight line between them.
  void move_to_hull(const Loop& border) {
    const std::vector<std::size_t> hull = hull_of(border);
    for (std::size_t h = 0; h < hull.size(); ++h) {
      const std::size_t begin = hull[h], end = h + 1 < hull.size() ? hull[h + 1] : hull[0] + border.size();
      spread(border, begin, end);
    }
  }

  void spread(const Loop& border, std::size_t begin, std::size_t end) {
    const auto at = [&](std::size_t i) -> Point2& { return r_[border[i % border.size()]]; };
    const auto length = [&](std::size_t i) {
      const double du = at(i + 1)[0] - at(i)[0], dv = at(i + 1)[1] - at(i)[1];
      return std::sqrt(du * du + dv * dv);
    };
    std::vector<double> along = {0};
    for (std::size_t i = begin; i < end; ++i) along.push_back(along.back() + length(i));
    const Point2 from = at(begin), to = at(end);
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double s = along[i - begin] / along.back();
      for (std::size_t k = 0; k < 2; ++k) at(i)[k] = from[k] + s * (to[k] - from[k]);
    }
  }

  static void bulge(Point2& r) {
    constexpr double how_much = 0x1p-8;
    const double scale = 1 + how_much * (1 - (r[0] * r[0] + r[1] * r[1]));
    r = {r[0] * scale, r[1] * scale};
  }

  /// Edges of a polygon ascend or descend (lexicographically); one that turns left does so once each while it turns once.
  bool turns_left_once(const Loop& border) const {
    const std::size_t n = border.size();
    const auto ascends = [&](std::size_t i) { return r_[border[i % n]] < r_[border[(i + 1) % n]]; };
    std::size_t tops = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const int turn = orientation(r_[border[i]], r_[border[(i + 1) % n]], r_[border[(i + 2) % n]]);
      if (turn < 0 || (turn == 0 && ascends(i) != ascends(i + 1))) return false;
      if (ascends(i) && !ascends(i + 1)) ++tops;
    }
    return tops == 1;
  }

  const Mesh& mesh_;
  std::span<const Position> x_;
  int dimension_;
  std::vector<Point2>& r_;
  std::vector<VertexId> vertices_;    ///< of the part at hand
  std::vector<std::uint32_t> place_;  ///< where in that list each vertex is
};

}  // namespace

Sheets find_sheets(const Mesh& mesh, std::span<const Position> x, int dimension, std::size_t least_faces) {
  Sheets sheets;
  sheets.layout.assign(mesh.vertex_count, Point2{});
  Flattener flattener(mesh, x, dimension, sheets.layout);
  for (Faces& part : parts_of(mesh)) {
    if (part.size() < least_faces) continue;
    (flattener.lay_out(part) ? sheets.faces : sheets.others).push_back(std::move(part));
  }
  return sheets;
}

}  // namespace noli
