// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <stdexcept>

#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/generators.h"
#include "integrator/scene/shapes/refine.h"
#include "integrator/scene/shapes/turn.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

/// Two triangles for each cell of a lattice of (columns + 1) x (rows + 1) vertices that are numbered row by row.
void add_lattice_faces(Mesh& mesh, std::uint32_t columns, std::uint32_t rows, Diagonals diagonals) {
  for (std::uint32_t j = 0; j < rows; ++j) {
    end_if_stopped();
    for (std::uint32_t i = 0; i < columns; ++i) {
      const VertexId a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;  // counterclockwise a b c d
      const bool other = diagonals == Diagonals::alternating && (i + j) % 2 == 1;
      mesh.faces.push_back(other ? std::array{a, b, d} : std::array{a, b, c});
      mesh.faces.push_back(other ? std::array{b, c, d} : std::array{a, c, d});
    }
  }
}

/// Coordinate i of n + 1 equally spaced ones from -size/2 to size/2: symmetric bit for bit.
double centred(std::uint32_t i, std::uint32_t n, double size) {
  return (static_cast<double>(2 * std::int64_t{i} - n) / n) * (size / 2);
}

/// Vertices of which this holds.
template <class Holds>
std::vector<VertexId> vertices_where(const Shape& shape, const Holds& holds) {
  std::vector<VertexId> ids;
  for (VertexId i = 0; i < shape.positions.size(); ++i) {
    if (holds(shape.positions[i])) ids.push_back(i);
  }
  return ids;
}

std::vector<VertexId> stride(VertexId first, VertexId step, std::uint32_t count) {
  std::vector<VertexId> ids;
  for (std::uint32_t k = 0; k < count; ++k) ids.push_back(first + k * step);
  return ids;
}

/// Part of x that is perpendicular to the unit vector t, of length 1.
Vec3 perpendicular(const Vec3& x, const Vec3& t) {
  const Vec3 p = x - x.dot(t) * t;
  const double length = std::sqrt(p.squaredNorm());
  if (!(length > 0)) throw std::invalid_argument("the band's side is along its curve");
  return p / length;
}

Vec3 unit(const Vec3& x) {
  const double length = std::sqrt(x.squaredNorm());
  if (!(length > 0)) throw std::invalid_argument("the curve turns back on itself");
  return x / length;
}

/// Direction of a curve at its k-th point.
Vec3 tangent(const std::vector<Vec3>& x, std::size_t k) {
  const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, x.size() - 1);
  return unit(x[after] - x[before]);
}

/// Vertex j of ring k of a disc.
VertexId disc_vertex(std::uint32_t k, std::uint32_t j) {
  if (k == 0) return 0;
  return 1 + 3 * k * (k - 1) + j % (6 * k);
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
  shape.sets = {{"left", vertices_where(shape, [x](const Position& p) { return p[0] == -x; })},
                {"right", vertices_where(shape, [x](const Position& p) { return p[0] == x; })},
                {"bottom", vertices_where(shape, [y](const Position& p) { return p[1] == -y; })},
                {"top", vertices_where(shape, [y](const Position& p) { return p[1] == y; })},
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
