// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "kernel/static_predicates.h"
#include "proofs/prover/windows/sheet.h"

namespace noli {

namespace {

using Faces = std::vector<std::uint32_t>;

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

/// Lays out one part.
class Flattener {
 public:
  /// `numbers`: scratch space, one entry per vertex of the mesh; all are `unused` on entry and on exit.
  Flattener(const Mesh& mesh, const Faces& part, std::vector<std::uint32_t>& numbers) {
    for (const std::uint32_t f : part) {
      for (const VertexId v : mesh.faces[f]) {
        if (numbers[v] != unused) continue;
        numbers[v] = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back(v);
      }
    }
    for (const std::uint32_t f : part) {
      const auto& [a, b, c] = mesh.faces[f];
      faces_.push_back({numbers[a], numbers[b], numbers[c]});
    }
    for (const VertexId v : vertices_) numbers[v] = unused;
  }

  static constexpr std::uint32_t unused = ~std::uint32_t{0};

  /// Whether the part is a sheet. If so, stores the layout of its vertices.
  bool lay_out(std::span<const Position> x, int dimension, std::vector<Point2>& layout) {
    project(x, dimension);
    if (!orient()) return false;
    const Border border = border_of(faces_, vertices_.size());
    if (border.size() < 3) return false;
    move_to_hull(border);
    for (Point2& r : r_) bulge(r);
    if (!is_sheet(faces_, r_)) return false;
    for (std::size_t i = 0; i < vertices_.size(); ++i) layout[vertices_[i]] = r_[i];
    return true;
  }

 private:
  using Border = std::vector<std::uint32_t>;

  /// Twice the sum of the absolute areas of the faces, seen along each axis.
  std::array<double, 3> areas(std::span<const Position> x) const {
    std::array<double, 3> sum{};
    for (const LocalFace& f : faces_) {
      const Position &a = x[vertices_[f[0]]], &b = x[vertices_[f[1]]], &c = x[vertices_[f[2]]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        sum[k] += std::abs((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]));
      }
    }
    return sum;
  }

  /// Projects along the axis along which the part looks largest, and scales to [-1, 1].
  void project(std::span<const Position> x, int dimension) {
    std::size_t along = 2;
    if (dimension == 3) {
      const auto area = areas(x);
      along = static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
    }
    r_.resize(vertices_.size());
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t axis = (along + 1 + k) % 3;
      double low = x[vertices_[0]][axis], high = low;
      for (const VertexId v : vertices_) {
        low = std::min(low, x[v][axis]);
        high = std::max(high, x[v][axis]);
      }
      const double middle = 0.5 * low + 0.5 * high, half = 0.5 * high - 0.5 * low;
      for (std::size_t i = 0; i < r_.size(); ++i) r_[i][k] = (x[vertices_[i]][axis] - middle) / half;
    }
  }

  /// Makes the layout of all faces counterclockwise. False if one is degenerate.
  bool orient() {
    if (!std::ranges::all_of(r_, [](const Point2& r) { return std::isfinite(r[0] + r[1]); })) return false;
    for (LocalFace& f : faces_) {
      const int side = orientation(r_[f[0]], r_[f[1]], r_[f[2]]);
      if (side == 0) return false;
      if (side < 0) std::swap(f[1], f[2]);
    }
    return true;
  }

  /// The places in the border that are corners of its convex hull, ascending (Andrew's monotone chain).
  std::vector<std::size_t> hull_of(const Border& border) const {
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

  /// Moves the vertices of the border between two corners of the hull to the straight line between them.
  void move_to_hull(const Border& border) {
    const std::vector<std::size_t> hull = hull_of(border);
    for (std::size_t h = 0; h < hull.size(); ++h) {
      spread(border, hull[h], h + 1 < hull.size() ? hull[h + 1] : hull[0] + border.size());
    }
  }

  void spread(const Border& border, std::size_t begin, std::size_t end) {
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

  std::vector<VertexId> vertices_;  ///< by number
  std::vector<LocalFace> faces_;
  std::vector<Point2> r_;  ///< by number
};

}  // namespace

Sheets find_sheets(const Mesh& mesh, std::span<const Position> x, int dimension, std::size_t least_faces) {
  Sheets sheets;
  sheets.layout.assign(mesh.vertex_count, Point2{});
  std::vector<std::uint32_t> numbers(mesh.vertex_count, Flattener::unused);
  for (Faces& part : parts_of(mesh)) {
    if (part.size() < least_faces) continue;
    const bool sheet = Flattener(mesh, part, numbers).lay_out(x, dimension, sheets.layout);
    (sheet ? sheets.faces : sheets.others).push_back(std::move(part));
  }
  return sheets;
}

}  // namespace noli
