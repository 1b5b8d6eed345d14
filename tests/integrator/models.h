// SPDX-License-Identifier: Apache-2.0
//
// Builds small models for tests of the integrator.
#pragma once

#include <cmath>
#include <cstdint>

#include "integrator/model.h"
#include "integrator/stable_step.h"

namespace noli::integrator::test {

/// A number in [-1, 1] that depends only on i.
inline double noise(std::uint64_t i) {
  i = (i + 0x9e3779b97f4a7c15) * 0xbf58476d1ce4e5b9;
  i = (i ^ (i >> 27)) * 0x94d049bb133111eb;
  return static_cast<double>(static_cast<std::int64_t>(i ^ (i >> 31))) * 0x1p-63;
}

/// Two masses on a spring of rest length 1, along the first axis, stretched by `stretch`.
template <int Dim>
Model<double, Dim> spring_pair(double m0, double m1, double k, double stretch, double step) {
  Model<double, Dim> model;
  Vec<double, Dim> far = Vec<double, Dim>::Zero();
  far[0] = 1 + stretch;
  model.x = {Vec<double, Dim>::Zero(), far};
  model.v = {Vec<double, Dim>::Zero(), Vec<double, Dim>::Zero()};
  model.mass = {m0, m1};
  model.forces.edge_springs.add({{0, 1}, k, 1, 0}, step);
  model.window_length = 16 * step;
  return model;
}

/// Sets steps to the estimate times a factor.
template <int Dim>
void choose_steps(Model<double, Dim>& model, double factor) {
  std::vector<double> w(model.x.size());
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = 1 / model.mass[i];
  for (const VertexId v : model.pinned) w[v] = 0;
  std::apply([&](auto&... list) { ((list.steps = stable_steps(list, model.x, w, factor)), ...); },
             model.forces.lists());
}

struct SheetOptions {
  int cells = 6;         ///< along each side
  double size = 1;       ///< [m]
  double wave = 0.1;     ///< of the initial shape, out of the plane [m]
  double speed = 0.5;    ///< of the random initial velocities [m/s]
  double damping = 0;    ///< [s]
  double window = 0.01;  ///< [s]
  bool membrane = true;  ///< else edge springs
  SheetMaterial<double> material{1e4, 0.3, 1e-3};
};

/// A square sheet of triangles, free in space and not at rest.
inline Model<double, 3> sheet(const SheetOptions& o) {
  Model<double, 3> model;
  const int n = o.cells;
  const double d = o.size / n;
  std::vector<Vec<double, 3>> rest;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const auto k = static_cast<std::uint64_t>(rest.size());
      rest.emplace_back(i * d, j * d, 0);
      model.x.emplace_back(i * d, j * d, o.wave * d * noise(k));
      model.v.emplace_back(o.speed * Vec<double, 3>(noise(3 * k + 1000), noise(3 * k + 1001), noise(3 * k + 1002)));
      model.mass.push_back(0.2 * d * d);
    }
  }
  const auto id = [n](int i, int j) { return static_cast<VertexId>(j * (n + 1) + i); };
  const auto at = [&rest](VertexId i) { return rest[i]; };
  const auto spring = [&](VertexId a, VertexId b) {
    model.forces.edge_springs.add({{a, b}, 50, (at(b) - at(a)).norm(), o.damping}, 1);
  };
  const auto hinge = [&](VertexId a, VertexId b, VertexId c, VertexId e) {
    model.forces.hinges.add(Hinge<double>::from_rest({a, b, c, e}, {at(a), at(b), at(c), at(e)}, 1e-3, o.damping), 1);
  };
  const auto face = [&](VertexId a, VertexId b, VertexId c) {
    model.mesh.faces.push_back({a, b, c});
    if (!o.membrane) return;
    model.forces.membranes.add(Membrane<double>::from_rest({a, b, c}, {at(a), at(b), at(c)}, o.material, o.damping), 1);
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      face(id(i, j), id(i + 1, j), id(i + 1, j + 1));
      face(id(i, j), id(i + 1, j + 1), id(i, j + 1));
      hinge(id(i, j), id(i + 1, j + 1), id(i, j + 1), id(i + 1, j));
      if (o.membrane) continue;
      spring(id(i, j), id(i + 1, j));
      spring(id(i, j), id(i, j + 1));
      spring(id(i, j), id(i + 1, j + 1));
    }
  }
  model.mesh.vertex_count = model.x.size();
  model.window_length = o.window;
  return model;
}

}  // namespace noli::integrator::test
