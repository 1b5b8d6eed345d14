// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/generators.h"
#include "integrator/scene/shapes/turn.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

/// Two triangles for each cell of a lattice of (columns + 1) x (rows + 1) vertices that are numbered row by row.
void add_lattice_faces(Mesh& mesh, std::uint32_t columns, std::uint32_t rows, Diagonals diagonals) {
  for (std::uint32_t j = 0; j < rows; ++j) {
    end_if_stopped();
    for (std::uint32_t i = 0; i < columns; ++i) {
      const VertexId a = j * (columns + 1) + i, d = a + columns + 1;
      add_cell(mesh, {a, a + 1, d + 1, d}, diagonals == Diagonals::alternating && (i + j) % 2 == 1);
    }
  }
}

/// Vertices with this coordinate.
std::vector<VertexId> vertices_at(const Shape& shape, std::size_t axis, double coordinate) {
  std::vector<VertexId> ids;
  for (VertexId i = 0; i < shape.positions.size(); ++i) {
    if (shape.positions[i][axis] == coordinate) ids.push_back(i);
  }
  return ids;
}

std::vector<VertexId> stride(VertexId first, VertexId step, std::uint32_t count) {
  std::vector<VertexId> ids;
  for (std::uint32_t k = 0; k < count; ++k) ids.push_back(first + k * step);
  return ids;
}

Vec3 unit(const Vec3& x, const char* problem) {
  if (!(length(x) > 0)) throw std::invalid_argument(problem);
  return x / length(x);
}

/// The part of x that is perpendicular to the unit vector t, scaled to length 1.
Vec3 perpendicular(const Vec3& x, const Vec3& t) {
  return unit(x - x.dot(t) * t, "expected a side of the band that is not along its curve");
}

/// Direction of a curve at its k-th point.
Vec3 tangent(const std::vector<Vec3>& x, std::size_t k) {
  const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, x.size() - 1);
  return unit(x[after] - x[before], "expected a curve that does not turn back on itself");
}

/// Vertex j of ring k of a disc.
VertexId disc_vertex(std::uint32_t k, std::uint32_t j) {
  if (k == 0) return 0;
  return 1 + 3 * k * (k - 1) + j % (6 * k);
}

// --- Smaller triangles in one place ----------------------------------------------------------------------------------

using Edge = std::array<VertexId, 2>;

Edge sorted(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Newest-vertex bisection of triangles (Mitchell, "A comparison of adaptive refinement techniques for elliptic
/// problems", 1989). Each triangle has a peak and, opposite to it, a base. Two triangles that share a base are halved
/// at its middle, which is the peak of their halves. A neighbour with a different base is halved first. So no vertex
/// ever lies inside an edge, and only a few new shapes of triangles appear. Faces are stored with their peaks first. No
/// vertex moves.
class Bisection {
 public:
  explicit Bisection(Shape& shape) : shape_(shape), faces_(shape.mesh.faces) {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      put_peak_first(faces_[f]);
      for (const Edge& edge : edges(faces_[f])) on_[edge].push_back(f);
    }
  }

  /// Halves face f, and any faces that must be halved for that.
  void halve(std::size_t f) {
    const Edge base = base_of(f);
    std::size_t other = across(base, f);
    while (other != none && base_of(other) != base) {
      halve(other);
      other = across(base, f);
    }
    const VertexId middle = shape_.add(to_position(0.5 * (at(base[0]) + at(base[1]))));
    split(f, middle);
    if (other != none) split(other, middle);
  }

  double longest_edge_squared(std::size_t f) const {
    double longest = 0;
    for (const auto& [a, b] : edges(faces_[f])) longest = std::max(longest, (at(b) - at(a)).squaredNorm());
    return longest;
  }

  bool contains(std::size_t f, const Vec3& p) const {
    const auto [a, b, c] = faces_[f];
    return side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0;
  }

  bool has_vertex_within(std::size_t f, const Vec3& p, double radius) const {
    return std::any_of(faces_[f].begin(), faces_[f].end(),
                       [&](VertexId v) { return (at(v) - p).squaredNorm() <= radius * radius; });
  }

  std::size_t size() const { return faces_.size(); }

 private:
  using Face = std::array<VertexId, 3>;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  static std::array<Edge, 3> edges(const Face& face) {
    return {sorted(face[1], face[2]), sorted(face[2], face[0]), sorted(face[0], face[1])};
  }

  Vec3 at(VertexId v) const { return to_vec(shape_.positions[v]); }
  Edge base_of(std::size_t f) const { return sorted(faces_[f][1], faces_[f][2]); }
  double side(VertexId a, VertexId b, const Vec3& p) const { return cross(at(b) - at(a), p - at(a))[2]; }

  void put_peak_first(Face& face) const {
    std::array<double, 3> opposite{};
    for (std::size_t k = 0; k < 3; ++k) opposite[k] = (at(face[(k + 1) % 3]) - at(face[(k + 2) % 3])).squaredNorm();
    std::rotate(face.begin(), face.begin() + (std::max_element(opposite.begin(), opposite.end()) - opposite.begin()),
                face.end());
  }

  std::size_t across(const Edge& edge, std::size_t f) const {
    for (const std::size_t other : on_.at(edge)) {
      if (other != f) return other;
    }
    return none;
  }

  /// Splits a face; the first half keeps the face's place.
  void split(std::size_t f, VertexId middle) {
    const auto [peak, left, right] = faces_[f];
    for (const Edge& edge : edges(faces_[f])) std::erase(on_[edge], f);
    put(f, {middle, peak, left});
    faces_.emplace_back();
    put(faces_.size() - 1, {middle, right, peak});
  }

  void put(std::size_t f, const Face& face) {
    faces_[f] = face;
    for (const Edge& edge : edges(face)) on_[edge].push_back(f);
  }

  Shape& shape_;
  std::vector<Face>& faces_;
  std::map<Edge, std::vector<std::size_t>> on_;  ///< faces on each edge
};

/// Halves triangles that contain a point of the plane, or have a vertex within `radius` of it, until their edges are at
/// most `longest`. New vertices are numbered after the existing ones. Preconditions: longest > 0; the faces are a
/// triangulation in the plane z = 0, in which the longest edge of a triangle is also that of its neighbour across it,
/// as in a lattice of halved rectangles.
void refine(Shape& shape, const std::array<double, 2>& at, double radius, double longest) {
  Bisection bisection(shape);
  const Vec3 p(at[0], at[1], 0);
  const auto too_large = [&](std::size_t f) {
    return bisection.longest_edge_squared(f) > longest * longest &&
           (bisection.contains(f, p) || bisection.has_vertex_within(f, p, radius));
  };
  for (bool halved = true; halved;) {
    halved = false;
    for (std::size_t f = 0; f < bisection.size(); ++f) {
      end_if_stopped();
      if (!too_large(f)) continue;
      bisection.halve(f);
      halved = true;
    }
  }
}

}  // namespace

Shape make_shape(const Grid& grid) {
  const auto [nx, ny] = grid.cells;
  Shape shape;
  for (std::uint32_t j = 0; j <= ny; ++j) {
    for (std::uint32_t i = 0; i <= nx; ++i) shape.add({centred(i, nx, grid.size[0]), centred(j, ny, grid.size[1]), 0});
  }
  add_lattice_faces(shape.mesh, nx, ny, grid.diagonals);
  if (grid.refine) {
    const double x = grid.size[0] / nx, y = grid.size[1] / ny;
    refine(shape, grid.refine->at, grid.refine->radius, std::sqrt(x * x + y * y) / grid.refine->factor);
  }
  const double x = grid.size[0] / 2, y = grid.size[1] / 2;
  const VertexId top = ny * (nx + 1);
  shape.sets = {{"left", vertices_at(shape, 0, -x)},
                {"right", vertices_at(shape, 0, x)},
                {"bottom", vertices_at(shape, 1, -y)},
                {"top", vertices_at(shape, 1, y)},
                {"left_bottom", {0}},
                {"right_bottom", {nx}},
                {"left_top", {top}},
                {"right_top", {top + nx}}};
  return shape;
}

Shape make_shape(const Ribbon& ribbon) {
  const std::vector<Vec3> curve = along_curve(ribbon.points, ribbon.segments, {.smooth = true});
  const std::uint32_t row = ribbon.across + 1;
  Shape shape;
  Vec3 side = to_vec(ribbon.side);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    side = perpendicular(side, tangent(curve, k));
    for (std::uint32_t i = 0; i < row; ++i) {
      shape.add(to_position(curve[k] + centred(i, ribbon.across, ribbon.width) * side));
    }
  }
  add_lattice_faces(shape.mesh, ribbon.across, ribbon.segments, Diagonals::alternating);
  for (auto& face : shape.mesh.faces) std::swap(face[1], face[2]);  // the curve is x, the side is y
  shape.sets = {{"first", stride(0, 1, row)},
                {"last", stride(ribbon.segments * row, 1, row)},
                {"left", stride(0, row, ribbon.segments + 1)},
                {"right", stride(ribbon.across, row, ribbon.segments + 1)}};
  return shape;
}

Shape make_shape(const Disc& disc) {
  Shape shape;
  shape.add({0, 0, 0});
  for (std::uint32_t k = 1; k <= disc.rings; ++k) {
    const double r = disc.radius * (static_cast<double>(k) / disc.rings);
    for (std::uint32_t j = 0; j < 6 * k; ++j) {
      const CosSin at = part_of_turn(j, 6 * k);
      shape.add({r * at.cos, r * at.sin, 0});
    }
    for (std::uint32_t sector = 0; sector < 6; ++sector) {
      end_if_stopped();
      for (std::uint32_t j = 0; j < k; ++j) {
        const VertexId inner = disc_vertex(k - 1, sector * (k - 1) + j), outer = disc_vertex(k, sector * k + j);
        const VertexId next_outer = disc_vertex(k, sector * k + j + 1);
        shape.mesh.faces.push_back({inner, outer, next_outer});
        if (j + 1 < k) shape.mesh.faces.push_back({inner, next_outer, disc_vertex(k - 1, sector * (k - 1) + j + 1)});
      }
    }
  }
  shape.sets = {{"centre", {0}}, {"rim", stride(disc_vertex(disc.rings, 0), 1, 6 * disc.rings)}};
  return shape;
}

}  // namespace noli::integrator
