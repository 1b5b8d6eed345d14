// SPDX-License-Identifier: Apache-2.0
//
// Builds the model that a run integrates from a scene.
//
// Notation
//   factor    of a cell: the product of the stiffness factors of the patches that contain its centre; of a hinge or
//             joint between two cells with factors f, g: 2 f g / (f + g), as springs in series add their compliances
//
//   sheet, elastic     a membrane for each face; for each edge of two faces a hinge of rigidity
//                      bending * E t^3 / (12 (1 - nu^2))
//   sheet, springs     a spring for each edge, a hinge of rigidity bending_stiffness for each edge of two faces
//   curve, elastic     a spring E t w / L for each edge; in the plane, where two edges meet, a turning angle of
//                      rigidity bending * E t^3 w / 12
//   curve, springs     a spring for each edge; in the plane a turning angle of rigidity bending_stiffness
//
// Steps: those that the scene gives; otherwise step_factor times the limit of stability (integrator/stable_step.h), at
// most the window. Forces whose vertices are all pinned or scripted move nothing and are left out.
//
// Curves in space do not bend. Contact at the start is not looked for here (certify/simulate/start_check.h does).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "integrator/model.h"
#include "integrator/scene/scene.h"

namespace noli::integrator {

/// The result for a body.
struct BuiltBody {
  std::string name;
  VertexId first = 0;                              ///< its vertices are first, ..., first + vertices - 1
  std::size_t vertices = 0, faces = 0, edges = 0;  ///< edges: those without a face
  double mass = 0;                                 ///< [kg]
  std::size_t pinned = 0, scripted = 0;            ///< vertices
  std::size_t idle_forces = 0;                     ///< left out, because they would move nothing
  double damped_steps = 1;                         ///< how many times shorter damping makes some chosen steps
  double damping_excess = 1;                       ///< how many times too long for damping some given steps are
  std::size_t open_edges = 0;                      ///< edges with one face, which do not bend
  std::size_t crowded = 0;  ///< edges with more than two faces, or two with the same vertices, and vertices with more
                            ///< than two loose edges; they do not bend

  bool has(VertexId v) const { return v >= first && v - first < vertices; }
};

/// Two bodies, or one class of vertices of each (integrator/scene/build_contact.h).
struct BuiltPair {
  std::array<std::size_t, 2> bodies;
  std::array<double, 2> heights_up_to;  ///< of cells [m]; infinite: all of the body
};

/// The result for one of the model's materials of contact.
struct BuiltContact {
  double least_mass = 0;         ///< of the free vertices of the bodies that have it [kg]
  double bound = 0;              ///< its thickness is below this [m]; infinite if nothing bounds it
  std::vector<BuiltPair> pairs;  ///< without pairs that have no free vertex
};

template <int Dim>
struct BuiltScene {
  Model<double, Dim> model;
  std::vector<BuiltBody> bodies;
  std::vector<BuiltContact> contact;  ///< one for each of model.contact->materials
};

/// Precondition: Dim is the scene's dimension. Throws an InputError that names the field: a mesh that does not load,
/// faces or edges without size, vertices that do not exist, scripts that do not fit, steps above the limit of stability
/// (unless allow_unstable), layers too thick for the mesh.
template <int Dim>
BuiltScene<Dim> build_model(const Scene& scene);

}  // namespace noli::integrator
