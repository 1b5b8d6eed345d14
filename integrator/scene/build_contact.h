// SPDX-License-Identifier: Apache-2.0
//
// How the bodies of a scene meet: Model::contact. Each body is a group. A body that moves has a class for each power of
// two by which the heights of its cells differ: a vertex is of the class of its lowest cell. So a mesh that is fine in
// one place has thin layers with short steps there, and thicker ones with longer steps elsewhere.
//
// Notation, for a pair of bodies, or of classes of them
//   H        least height of a triangle at rest, or length of an edge that has no face, over the cells of the two
//            bodies that have a free vertex; of a class, over those cells with a vertex of it or of one before it
//   eta(1)   thickness, below H / 2: two features of one body that share no vertex are then farther apart at rest than
//            a layer is thick, but for meshes that fold onto themselves
//   m, M     least and greatest mass of the two bodies' free vertices; M of a class beside a lighter one: that one's
//   v        a speed at which things may meet: the greatest at the start, the greatest of a script, and
//            sqrt(2 g . (lowest - highest)), added; at least eta(1) / window
//
// Defaults: eta(1) = H / 4; r(1) = M (v / eta(1))^2, so that a vertex which comes with v is stopped between a whole and
// half a thickness, where layers hold 0 to 19 r(1) eta(1)^2; h(1) = c sqrt(m / (2 r(1))), at most the window.
//
// What this does not do: it does not look at distances in the start.
#pragma once

#include <vector>

#include "integrator/scene/build_model.h"
#include "integrator/scene/shapes/body_mesh.h"

namespace noli::integrator {

/// Fills built.model.contact and built.contact if the scene has contact. Pairs of which nothing is free are excluded
/// like those that the scene excludes. `bodies`: one for each of the scene; inverse_mass: one for each vertex, 0 for
/// what is pinned or scripted. Throws InputError: a thickness not below H / 2, defaults that cannot be made.
template <int Dim>
void add_contact(const Scene& scene, const std::vector<BodyMesh>& bodies, const std::vector<double>& inverse_mass,
                 BuiltScene<Dim>& built);

}  // namespace noli::integrator
