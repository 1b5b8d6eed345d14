// SPDX-License-Identifier: Apache-2.0
//
// Makes the elastic forces of one body (build_model.h lists them), without steps.
#pragma once

#include "integrator/model.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/shapes/body_mesh.h"

namespace noli::integrator {

/// The origin of a force.
struct Origin {
  std::uint32_t body = 0;
  Position centre{};  ///< at the start
};

/// Forces of one kind, of all bodies, each with its origin.
template <class F>
struct Sourced {
  std::vector<F> forces;
  std::vector<Origin> origins;

  void add(const F& force, const Origin& origin) {
    forces.push_back(force);
    origins.push_back(origin);
  }
};

template <int Dim>
using SourcedForces = OfEachForce<Sourced, double, Dim>;

/// Appends the forces of a body whose first vertex is built.first; counts places without bending in `built`. Throws
/// InputError for cells without size.
void add_forces(const Scene& scene, std::size_t body, const BodyMesh& mesh, BuiltBody& built, SourcedForces<3>& forces);
void add_forces(const Scene& scene, std::size_t body, const BodyMesh& mesh, BuiltBody& built, SourcedForces<2>& forces);

}  // namespace noli::integrator
