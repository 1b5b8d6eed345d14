// SPDX-License-Identifier: Apache-2.0
//
// The model that a run integrates: particles, forces with their steps, scripts. It is built from a scene
// (integrator/scene), or by hand in tests and benchmarks.
//
// Notation
//   h        a force's step [s]; it fires at the times k h, k = 1, 2, ...
//   window   a piece of simulated time up to the next multiple of W = window_length, or up to the time at which it has
//            most_breakpoints. Its end is an event that advances every particle, so both parameters determine the run
//
// integrator/stable_step.h computes stable steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <noli/mesh.h>
#include "integrator/contact_settings.h"
#include "integrator/force.h"
#include "integrator/forces/edge_spring.h"
#include "integrator/forces/hinge.h"
#include "integrator/forces/membrane.h"
#include "integrator/forces/turning.h"

namespace noli::integrator {

/// Forces of one kind, each with its step. Order is that of the mesh.
template <class F>
struct ForceList {
  std::vector<F> forces;
  std::vector<double> steps;  ///< h of each [s], positive

  void add(const F& force, double step) {
    forces.push_back(force);
    steps.push_back(step);
  }
};

/// A path that a vertex follows despite all forces: linear between breakpoints, at rest before the first and after the
/// last. Its mass counts as infinite.
template <class S, int Dim>
struct Script {
  VertexId vertex = 0;
  std::vector<double> times;           ///< strictly ascending, not negative [s]
  std::vector<Vec<S, Dim>> positions;  ///< one for each time
  std::uint32_t number = 0;            ///< of the scene's scripts, one of which may move many vertices
};

/// A constant acceleration of all particles that are neither pinned nor scripted.
template <class S, int Dim>
struct Gravity {
  Vec<S, Dim> acceleration;  ///< [m/s^2]
  double step = 0;           ///< the longest [s]; a vertex takes the step of the forces on it if that is shorter
  /// The longest step of vertices without forces [s].
  double step_without_forces = std::numeric_limits<double>::infinity();
};

template <class S, int Dim>
struct Forces;

template <class S>
struct Forces<S, 3> {
  ForceList<EdgeSpring<S, 3>> edge_springs;
  ForceList<Membrane<S>> membranes;
  ForceList<Hinge<S>> hinges;

  auto lists() { return std::tie(edge_springs, membranes, hinges); }
  auto lists() const { return std::tie(edge_springs, membranes, hinges); }
};

template <class S>
struct Forces<S, 2> {
  ForceList<EdgeSpring<S, 2>> edge_springs;
  ForceList<Turning<S>> turnings;

  auto lists() { return std::tie(edge_springs, turnings); }
  auto lists() const { return std::tie(edge_springs, turnings); }
};

/// Only its type is used.
template <template <class> class Of, class... F>
std::tuple<Of<F>...> of_each(const std::tuple<const ForceList<F>&...>& lists);

/// A tuple of one Of<F> for each list of forces F, in the order of lists().
template <template <class> class Of, class S, int Dim>
using OfEachForce = decltype(of_each<Of>(std::declval<const Forces<S, Dim>&>().lists()));

enum class Clocks : std::uint8_t { grouped, own };

template <class S, int Dim>
struct Model {
  Mesh mesh;                            ///< the cells, for verification; forces list their own vertices
  std::vector<Vec<S, Dim>> x;           ///< positions at time 0 [m]
  std::vector<Vec<S, Dim>> v;           ///< velocities at time 0 [m/s]
  std::vector<S> mass;                  ///< [kg], positive; ignored for pinned and scripted vertices
  std::vector<VertexId> pinned;         ///< vertices that never move
  std::vector<Script<S, Dim>> scripts;  ///< at most one per vertex; not for pinned ones
  std::optional<Gravity<S, Dim>> gravity;
  Forces<S, Dim> forces;
  double window_length = 0;  ///< W [s], positive
  /// A window with this many breakpoints, including those at its beginning, ends after all events of that time.
  std::size_t most_breakpoints = std::numeric_limits<std::size_t>::max();
  Clocks clocks = Clocks::grouped;
  std::optional<ContactSettings> contact;  ///< nothing: the first contact ends the run
};

/// By vertex: 1 if it is pinned or scripted, so that no force moves it.
template <class S, int Dim>
std::vector<std::uint8_t> held_vertices(const Model<S, Dim>& model) {
  std::vector<std::uint8_t> held(model.x.size(), 0);
  for (const VertexId v : model.pinned) held[v] = 1;
  for (const auto& script : model.scripts) held[script.vertex] = 1;
  return held;
}

/// The diagonal of the box around all points [m].
template <int Dim>
double extent(const std::vector<Vec<double, Dim>>& points) {
  if (points.empty()) return 0;
  Vec<double, Dim> low = points.front(), high = low;
  for (const auto& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).norm();
}

}  // namespace noli::integrator
