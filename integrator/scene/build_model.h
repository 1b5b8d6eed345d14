// SPDX-License-Identifier: Apache-2.0
//
// From a scene to what a run integrates.
//
// Notation
//   factor    of a cell: the product of the stiffness factors of the patches its centre is in; of a hinge or joint
//             between two cells f, g: 2 f g / (f + g), as springs in a row add their compliances
//
//   sheet, elastic     a membrane for each face; for each edge of two faces a hinge of rigidity
//                      bending * E t^3 / (12 (1 - nu^2))
//   sheet, springs     a spring for each edge, a hinge of rigidity bending_stiffness for each edge of two faces
//   curve, elastic     a spring E t w / L for each edge; in the plane, where two edges meet, a turning angle of
//                      rigidity bending * E t^3 w / 12
//   curve, springs     a spring for each edge; in the plane a turning angle of rigidity bending_stiffness
//
// Steps: those that the scene gives; else step_factor times the limit of stability (integrator/stable_step.h), at most
// the window. Forces that move nothing, all their vertices being pinned or scripted, are left out.
//
// What this does not do: it does not look for contact in the start (the app does, exactly), and curves in space
// do not bend.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "integrator/model.h"
#include "integrator/scene/scene.h"

namespace noli::integrator {

/// What became of a body.
struct BuiltBody {
  std::string name;
  VertexId first = 0;                              ///< its vertices are first, ..., first + vertices - 1
  std::size_t vertices = 0, faces = 0, edges = 0;  ///< edges: those of no face
  double mass = 0;                                 ///< [kg]
  std::size_t pinned = 0, scripted = 0;            ///< vertices
  std::size_t idle_forces = 0;                     ///< left out, because they would move nothing
  std::size_t open_edges = 0;                      ///< edges of one face: nothing to bend
  std::size_t crowded = 0;  ///< edges of more than two faces, or of two with the same vertices, and vertices of more
                            ///< than two loose edges: nothing bends there

  bool has(VertexId v) const { return v >= first && v - first < vertices; }
};

/// Two bodies, or of each the vertices whose cells are of one class (integrator/scene/build_contact.h).
struct BuiltPair {
  std::array<std::size_t, 2> bodies;
  std::array<double, 2> heights_up_to;  ///< of cells [m]; infinite: all of the body
};

/// What became of how bodies meet: one of the model's materials.
struct BuiltContact {
  double least_mass = 0;         ///< of the free vertices of the bodies that have it [kg]
  double bound = 0;              ///< its thickness is below this [m]; infinite if nothing bounds it
  std::vector<BuiltPair> pairs;  ///< those of which nothing is free are not there
};

template <int Dim>
struct BuiltScene {
  Model<double, Dim> model;
  std::vector<BuiltBody> bodies;
  std::vector<BuiltContact> contact;  ///< one for each of model.contact->materials
};

/// Precondition: Dim is the scene's dimension. Throws InputError that names the field: a mesh that does not load, faces
/// or edges without size, vertices that are not there, scripts that do not fit, steps above the limit of stability
/// (unless allow_unstable), layers too thick for the mesh.
template <int Dim>
BuiltScene<Dim> build_model(const Scene& scene);

}  // namespace noli::integrator
