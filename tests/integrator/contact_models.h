// SPDX-License-Identifier: Apache-2.0
//
// Builds small models with contact.
#pragma once

#include "integrator/contact_extremes.h"
#include "integrator/simulation.h"
#include "models.h"

namespace noli::integrator::test {

namespace detail {

/// Appends forces whose vertices are renumbered to start at `first`.
template <class F>
void append_forces(ForceList<F>& to, const ForceList<F>& from, VertexId first) {
  for (std::size_t k = 0; k < from.forces.size(); ++k) {
    F force = from.forces[k];
    for (VertexId& i : force.vertices) i += first;
    to.add(force, from.steps[k]);
  }
}

template <class Cells>
void append_cells(Cells& to, Cells from, VertexId first) {
  for (auto& cell : from) {
    for (VertexId& i : cell) i += first;
    to.push_back(cell);
  }
}

}  // namespace detail

/// Both models in one: vertices of b follow those of a. Gravity, window and clocks are those of a.
template <int Dim>
Model<double, Dim> both(Model<double, Dim> a, const Model<double, Dim>& b) {
  const auto first = static_cast<VertexId>(a.x.size());
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(a.x, b.x);
  append(a.v, b.v);
  append(a.mass, b.mass);
  detail::append_cells(a.mesh.faces, b.mesh.faces, first);
  detail::append_cells(a.mesh.edges, b.mesh.edges, first);
  for (const VertexId i : b.mesh.points) a.mesh.points.push_back(first + i);
  for (const VertexId i : b.pinned) a.pinned.push_back(first + i);
  for (auto script : b.scripts) {
    script.vertex += first;
    a.scripts.push_back(script);
  }
  detail::append_forces(a.forces.edge_springs, b.forces.edge_springs, first);
  if constexpr (Dim == 3) {
    detail::append_forces(a.forces.membranes, b.forces.membranes, first);
    detail::append_forces(a.forces.hinges, b.forces.hinges, first);
  } else {
    detail::append_forces(a.forces.turnings, b.forces.turnings, first);
  }
  a.mesh.vertex_count = a.x.size();
  return a;
}

/// Masses of `mass` each, with springs from one to the next, and from the last to the first if closed. In the plane,
/// turns are stiff too. The initial shape is the rest shape.
template <int Dim>
Model<double, Dim> chain(std::vector<Vec<double, Dim>> x, bool closed, double stiffness, double mass,
                         double bending = 0.01) {
  Model<double, Dim> model;
  const std::size_t n = x.size();
  model.x = std::move(x);
  model.v.assign(n, Vec<double, Dim>::Zero());
  model.mass.assign(n, mass);
  model.mesh.vertex_count = n;
  model.window_length = 0.01;
  for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k) {
    const auto a = static_cast<VertexId>(k), b = static_cast<VertexId>((k + 1) % n);
    const auto c = static_cast<VertexId>((k + 2) % n);
    model.mesh.edges.push_back({a, b});
    model.forces.edge_springs.add({{a, b}, stiffness, (model.x[b] - model.x[a]).norm(), 0}, 1);
    if constexpr (Dim == 2) {
      if (!closed && k + 2 >= n) continue;
      model.forces.turnings.add(
          Turning<double>::from_rest({a, b, c}, {model.x[a], model.x[b], model.x[c]}, bending, 0.0), 1);
    }
  }
  return model;
}

/// Loose points.
template <int Dim>
Model<double, Dim> points(std::vector<Vec<double, Dim>> x, double mass) {
  Model<double, Dim> model;
  for (std::size_t k = 0; k < x.size(); ++k) model.mesh.points.push_back(static_cast<VertexId>(k));
  model.v.assign(x.size(), Vec<double, Dim>::Zero());
  model.mass.assign(x.size(), mass);
  model.x = std::move(x);
  model.mesh.vertex_count = model.x.size();
  model.window_length = 0.01;
  return model;
}

/// Shifts each vertex by `by` and adds `v` to its velocity.
template <int Dim>
Model<double, Dim> moved(Model<double, Dim> model, const Vec<double, Dim>& by, const Vec<double, Dim>& v) {
  for (auto& x : model.x) x += by;
  for (auto& w : model.v) w += v;
  return model;
}

/// Scripts all vertices along `path`, relative to their initial positions, and removes all forces.
template <int Dim>
Model<double, Dim> scripted(Model<double, Dim> model, const std::vector<double>& times,
                            const std::vector<Vec<double, Dim>>& path) {
  for (std::size_t i = 0; i < model.x.size(); ++i) {
    Script<double, Dim> script{static_cast<VertexId>(i), times, {}};
    for (const auto& move : path) script.positions.push_back(model.x[i] + move);
    model.scripts.push_back(std::move(script));
  }
  model.forces = {};
  return model;
}

/// Pins all vertices and removes all forces.
template <int Dim>
Model<double, Dim> held(Model<double, Dim> model) {
  for (std::size_t i = 0; i < model.x.size(); ++i) model.pinned.push_back(static_cast<VertexId>(i));
  model.forces = {};
  return model;
}

/// The initial positions.
template <int Dim>
std::vector<Position> positions(const Model<double, Dim>& model) {
  std::vector<Position> result;
  for (const auto& x : model.x) result.push_back({x[0], x[1], Dim == 3 ? x[Dim - 1] : 0.0});
  return result;
}

struct ContactOptions {
  double thickness = 0.01, stiffness = 100, c = 0.05, restitution = 1, friction = 0;
};

/// Adds contact with one material; h(1) follows from c and the least mass.
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

/// Two free sheets that fly into each other, one slightly tilted.
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
