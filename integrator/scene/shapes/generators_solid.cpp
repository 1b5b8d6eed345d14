// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>
#include <utility>

#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/generators.h"
#include "integrator/scene/shapes/turn.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

/// Reverses the last `count` faces.
void turn_over(Mesh& mesh, std::size_t count) {
  for (auto face = mesh.faces.end() - static_cast<std::ptrdiff_t>(count); face != mesh.faces.end(); ++face) {
    std::swap((*face)[1], (*face)[2]);
  }
}

Position on_unit_sphere(const Vec3& x) { return to_position(x / std::sqrt(x.squaredNorm())); }

/// The icosahedron with vertices (0, +-1, +-phi) and their cyclic permutations, phi the golden ratio. Its faces are the
/// triples of neighbouring vertices, looking outward.
Shape icosahedron() {
  const double phi = (1 + std::sqrt(5.0)) / 2;
  Shape shape;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-phi, phi}) {
      for (const Vec3& x : {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)}) shape.add(on_unit_sphere(x));
    }
  }
  const auto x = [&shape](VertexId i) { return to_vec(shape.positions[i]); };
  const auto neighbours = [&](VertexId i, VertexId j) { return (x(i) - x(j)).squaredNorm() < 2; };
  for (VertexId a = 0; a < 12; ++a) {
    for (VertexId b = a + 1; b < 12; ++b) {
      for (VertexId c = b + 1; c < 12; ++c) {
        if (!neighbours(a, b) || !neighbours(b, c) || !neighbours(c, a)) continue;
        const double outward = x(a).dot(cross(x(b) - x(a), x(c) - x(a)));
        shape.mesh.faces.push_back(outward > 0 ? std::array{a, b, c} : std::array{a, c, b});
      }
    }
  }
  return shape;
}

/// Splits each face into four; new vertices are moved onto the sphere.
void subdivide(Shape& shape) {
  std::map<std::pair<VertexId, VertexId>, VertexId> middles;
  const auto middle = [&](VertexId a, VertexId b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), 0);
    if (is_new) at->second = shape.add(on_unit_sphere(to_vec(shape.positions[a]) + to_vec(shape.positions[b])));
    return at->second;
  };
  std::vector<std::array<VertexId, 3>> finer;
  for (const auto& [a, b, c] : shape.mesh.faces) {
    end_if_stopped();
    const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  shape.mesh.faces = std::move(finer);
}

/// The vertices of the surface of a box, without duplicates.
class BoxLattice {
 public:
  explicit BoxLattice(const SurfaceOfBox& box) : box_(box) {}

  /// Adds the side on which coordinate `axis` is least or greatest.
  void add_side(std::size_t axis, bool greatest) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<std::uint32_t, 3> at{};
    at[axis] = greatest ? box_.cells[axis] : 0;
    for (at[v] = 0; at[v] < box_.cells[v]; ++at[v]) {
      for (at[u] = 0; at[u] < box_.cells[u]; ++at[u]) add_cell(at, u, v, greatest);
    }
  }

  Shape shape;

 private:
  void add_cell(std::array<std::uint32_t, 3> at, std::size_t u, std::size_t v, bool outward) {
    const bool other = (at[u] + at[v]) % 2 == 1;
    const VertexId a = vertex(at);
    ++at[u];
    const VertexId b = vertex(at);
    ++at[v];
    const VertexId c = vertex(at);
    --at[u];
    const VertexId d = vertex(at);
    integrator::add_cell(shape.mesh, {a, b, c, d}, other);
    if (!outward) turn_over(shape.mesh, 2);
  }

  VertexId vertex(const std::array<std::uint32_t, 3>& at) {
    end_if_stopped();
    const auto [found, is_new] = ids_.try_emplace(at, 0);
    if (!is_new) return found->second;
    Position x{};
    for (std::size_t axis = 0; axis < 3; ++axis) x[axis] = centred(at[axis], box_.cells[axis], box_.size[axis]);
    return found->second = shape.add(x);
  }

  const SurfaceOfBox& box_;
  std::map<std::array<std::uint32_t, 3>, VertexId> ids_;
};

/// Adds the cells between successive rings of vertices; vertex(k, j) is vertex j of ring k.
template <class Vertex>
void add_tube_faces(Mesh& mesh, std::uint32_t segments, std::uint32_t sides, const Vertex& vertex) {
  for (std::uint32_t k = 0; k < segments; ++k) {
    end_if_stopped();
    for (std::uint32_t j = 0; j < sides; ++j) {
      add_cell(mesh, {vertex(k, j), vertex(k + 1, j), vertex(k + 1, j + 1), vertex(k, j + 1)}, (k + j) % 2 == 1);
    }
  }
}

}  // namespace

Shape make_shape(const Rod& rod) {
  const std::uint32_t n = rod.segments, sides = rod.sides;
  Shape shape;
  for (std::uint32_t k = 0; k <= n; ++k) {
    const double x = centred(k, n, rod.length);
    for (std::uint32_t j = 0; j < sides; ++j) {
      const CosSin at = part_of_turn(j, sides);
      shape.add({x, rod.radius * at.cos, rod.radius * at.sin});
    }
  }
  const VertexId first = shape.add({-rod.length / 2, 0, 0}), last = shape.add({rod.length / 2, 0, 0});
  const auto vertex = [sides](std::uint32_t k, std::uint32_t j) { return k * sides + j % sides; };
  add_tube_faces(shape.mesh, n, sides, vertex);
  turn_over(shape.mesh, shape.mesh.faces.size());
  for (std::uint32_t j = 0; j < sides; ++j) {
    shape.mesh.faces.push_back({first, vertex(0, j + 1), vertex(0, j)});
    shape.mesh.faces.push_back({last, vertex(n, j), vertex(n, j + 1)});
    shape.sets["first"].push_back(vertex(0, j));
    shape.sets["last"].push_back(vertex(n, j));
  }
  shape.sets["first"].push_back(first);
  shape.sets["last"].push_back(last);
  return shape;
}

Shape make_shape(const Sphere& sphere) {
  Shape shape = icosahedron();
  for (std::uint32_t level = 0; level < sphere.subdivisions; ++level) subdivide(shape);
  for (Position& x : shape.positions) x = {sphere.radius * x[0], sphere.radius * x[1], sphere.radius * x[2]};
  return shape;
}

Shape make_shape(const Torus& torus) {
  const std::uint32_t n = torus.segments, sides = torus.sides;
  Shape shape;
  for (std::uint32_t k = 0; k < n; ++k) {
    const CosSin along = part_of_turn(k, n);
    for (std::uint32_t j = 0; j < sides; ++j) {
      const CosSin about = part_of_turn(j, sides);
      const double r = torus.radius + torus.tube_radius * about.cos;
      shape.add({r * along.cos, r * along.sin, torus.tube_radius * about.sin});
    }
  }
  const auto vertex = [n, sides](std::uint32_t k, std::uint32_t j) { return (k % n) * sides + j % sides; };
  add_tube_faces(shape.mesh, n, sides, vertex);
  return shape;
}

Shape make_shape(const Pyramid& pyramid) {
  Shape shape;
  for (std::uint32_t j = 0; j < pyramid.sides; ++j) {
    const CosSin at = part_of_turn(j, pyramid.sides);
    shape.sets["base"].push_back(shape.add({pyramid.radius * at.cos, pyramid.radius * at.sin, 0}));
  }
  const VertexId tip = shape.add({0, 0, pyramid.height});
  for (VertexId j = 0; j < tip; ++j) shape.mesh.faces.push_back({j, (j + 1) % tip, tip});
  shape.sets["tip"] = {tip};
  return shape;
}

Shape make_shape(const SurfaceOfBox& box) {
  BoxLattice lattice(box);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool greatest : {false, true}) lattice.add_side(axis, greatest);
  }
  return std::move(lattice.shape);
}

}  // namespace noli::integrator
