// SPDX-License-Identifier: Apache-2.0
#include "sheets.h"

#include <cmath>
#include <map>

namespace noli::testing {

namespace {

void add_square(Mesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  mesh.faces.push_back({a, b, c});
  mesh.faces.push_back({a, c, d});
}

}  // namespace

Surface grid(std::uint32_t n, std::uint32_t m) {
  Surface surface;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= m; ++j) surface.x.push_back({static_cast<double>(i), static_cast<double>(j), 0});
  }
  surface.mesh.vertex_count = surface.x.size();
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const VertexId a = i * (m + 1) + j, b = a + m + 1;
      add_square(surface.mesh, a, b, b + 1, a + 1);
    }
  }
  return surface;
}

Surface closed_box(std::uint32_t n) {
  Surface surface;
  std::map<Position, VertexId> ids;
  const auto id = [&](const Position& x) {
    const auto [place, fresh] = ids.emplace(x, static_cast<VertexId>(ids.size()));
    if (fresh) surface.x.push_back(x);
    return place->second;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double side : {0.0, static_cast<double>(n)}) {
      for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
          const auto at = [&](std::uint32_t p, std::uint32_t q) {
            Position x;
            x[k] = side;
            x[(k + 1) % 3] = p;
            x[(k + 2) % 3] = q;
            return id(x);
          };
          add_square(surface.mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
      }
    }
  }
  surface.mesh.vertex_count = surface.x.size();
  return surface;
}

Surface ring_of_squares(std::uint32_t n) {
  Surface surface;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * i / n;
    for (const double r : {1.0, 2.0}) surface.x.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  surface.mesh.vertex_count = surface.x.size();
  for (std::uint32_t i = 0; i < n; ++i) {
    const VertexId a = 2 * i, b = 2 * ((i + 1) % n);
    add_square(surface.mesh, a, a + 1, b + 1, b);
  }
  return surface;
}

void append(Surface& surface, const Surface& other, const Position& by) {
  const auto first = static_cast<VertexId>(surface.x.size());
  for (const Position& x : other.x) surface.x.push_back({x[0] + by[0], x[1] + by[1], x[2] + by[2]});
  for (const auto& f : other.mesh.faces) surface.mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  surface.mesh.vertex_count = surface.x.size();
}

void turn(Surface& surface, double a, double b, double c) {
  for (Position& x : surface.x) {
    x[0] += a * x[1];
    x[1] -= a * x[0];
    x[1] += b * x[2];
    x[2] -= b * x[1];
    x[2] += c * x[0];
    x[0] -= c * x[2];
  }
}

}  // namespace noli::testing
