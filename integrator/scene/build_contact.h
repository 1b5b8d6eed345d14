// SPDX-License-Identifier: Apache-2.0
//
// Makes Model::contact: how the bodies of a scene meet. Each body is a group. A moving body has a class for each power
// of two by which the heights of its cells differ: a vertex has the class of its lowest cell. So a mesh with a fine
// part has thin layers with short steps there, and thicker ones with longer steps elsewhere.
//
// Notation, for a pair of bodies, or of their classes
//   H        least height of a triangle at rest, or length of an edge without a face, over the cells of the two bodies
//            that have a free vertex; for a class, over those of these cells with a vertex of it or of an earlier class
//   eta(1)   thickness, below H / 2: two features of one body that share no vertex are then farther apart at rest than
//            a layer is thick, except in meshes that fold onto themselves
//   m, M     least and greatest mass of the two bodies' free vertices; M of a class that meets a lighter one is the
//            lighter one's
//   v        a speed at which bodies may meet, the sum of: the greatest at the start, the greatest of a script, and
//            sqrt(2 g . (lowest - highest)); at least eta(1) / window
//
// Defaults: eta(1) = H / 4. r(1) = M (v / eta(1))^2, so that a vertex with speed v is stopped between a whole and half
// a thickness, where layers hold 0 to 19 r(1) eta(1)^2. h(1) = c sqrt(m / (2 r(1))), at most the window.
#pragma once

#include <vector>

#include "integrator/scene/build_model.h"
#include "integrator/scene/shapes/body_mesh.h"

namespace noli::integrator {

/// Fills built.model.contact and built.contact if the scene has contact. Pairs without free vertices are excluded like
/// those that the scene excludes. `bodies`: one for each body of the scene; inverse_mass: one for each vertex, 0 if it
/// is pinned or scripted. Throws InputError: a thickness not below H / 2, defaults that cannot be computed.
template <int Dim>
void add_contact(const Scene& scene, const std::vector<BodyMesh>& bodies, const std::vector<double>& inverse_mass,
                 BuiltScene<Dim>& built);

}  // namespace noli::integrator
