// SPDX-License-Identifier: Apache-2.0
//
// Small models in which things touch.
#pragma once

#include "models.h"
#include "noli/integrator/contact_limit.h"
#include "noli/integrator/simulation.h"

namespace noli::integrator::test {

/// Puts b beside a: vertices of b follow those of a.
inline Model<double, 3> both(Model<double, 3> a, const Model<double, 3>& b) {
  const auto first = static_cast<VertexId>(a.x.size());
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(a.x, b.x);
  append(a.v, b.v);
  append(a.mass, b.mass);
  for (auto face : b.mesh.faces) {
    for (VertexId& i : face) i += first;
    a.mesh.faces.push_back(face);
  }
  for (const VertexId i : b.pinned) a.pinned.push_back(first + i);
  const auto add_forces = [first](auto& to, const auto& from) {
    for (std::size_t k = 0; k < from.forces.size(); ++k) {
      auto force = from.forces[k];
      for (VertexId& i : force.vertices) i += first;
      to.add(force, from.steps[k]);
    }
  };
  add_forces(a.forces.edge_springs, b.forces.edge_springs);
  add_forces(a.forces.membranes, b.forces.membranes);
  add_forces(a.forces.hinges, b.forces.hinges);
  a.mesh.vertex_count = a.x.size();
  return a;
}

/// Where the vertices begin.
inline std::vector<Position> positions(const Model<double, 3>& model) {
  std::vector<Position> result;
  for (const auto& x : model.x) result.push_back({x[0], x[1], x[2]});
  return result;
}

struct ContactOptions {
  double thickness = 0.01, stiffness = 100, c = 0.05, restitution = 1, friction = 0;
};

/// One material for all; h(1) from c (the least mass).
template <int Dim>
Model<double, Dim> with_contact(Model<double, Dim> model, const ContactOptions& o) {
  double least = model.mass.front();
  for (const double m : model.mass) least = std::min(least, m);
  ContactSettings settings;
  const double step = o.c * std::sqrt(least / (2 * o.stiffness));
  settings.materials = {{o.thickness, o.stiffness, step, o.restitution, o.friction}};
  settings.groups.assign(model.x.size(), 0);
  settings.material_of = {0};
  model.contact = settings;
  return model;
}

/// Two free sheets that fly into each other, one a little aslant.
inline Model<double, 3> colliding_sheets(int cells, double speed) {
  SheetOptions o;
  o.cells = cells;
  o.speed = 0.1;
  Model<double, 3> below = sheet(o), above = sheet(o);
  for (std::size_t i = 0; i < above.x.size(); ++i) {
    const Vec<double, 3> x = above.x[i];
    above.x[i] = Vec<double, 3>(x[0] - 0.1 * x[1] + 0.031, x[1] + 0.1 * x[0] + 0.017, x[2] + 0.05 + 0.1 * x[0]);
    above.v[i][2] -= speed;
    above.v[i][0] += 0.3 * speed;
  }
  Model<double, 3> model = both(std::move(below), above);
  choose_steps(model, 0.5);
  return model;
}

/// In the plane: a point of mass 1 above a pinned edge.
inline Model<double, 2> ball_and_floor(double height, double speed) {
  Model<double, 2> model;
  model.mesh.vertex_count = 3;
  model.mesh.points = {0};
  model.mesh.edges = {{1, 2}};
  model.x = {{0.1, height}, {-1, 0}, {1, 0}};
  model.v = {{0, -speed}, {0, 0}, {0, 0}};
  model.mass = {1, 1, 1};
  model.pinned = {1, 2};
  model.window_length = 0.01;
  return model;
}

}  // namespace noli::integrator::test
