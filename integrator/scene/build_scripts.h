// SPDX-License-Identifier: Apache-2.0
//
// Scripted vertices: from displacements or frames to the path of each vertex.
#pragma once

#include "integrator/scene/build_model.h"
#include "integrator/scene/shapes/body_mesh.h"

namespace noli::integrator {

/// Scripts of a scene, and the start positions and velocities that they change: a scripted vertex begins where its path
/// does, and its start velocity is zero here, as its path knows better. `bodies`, `built`: as many as the scene has.
/// Fills in built[i].scripted. Throws InputError: vertices that are not there, that are pinned, that another script
/// moves; frames that do not load or have another number of vertices.
template <int Dim>
void add_scripts(const Scene& scene, const std::vector<BodyMesh>& bodies, std::vector<BuiltBody>& built,
                 Model<double, Dim>& model);

extern template void add_scripts(const Scene&, const std::vector<BodyMesh>&, std::vector<BuiltBody>&,
                                 Model<double, 2>&);
extern template void add_scripts(const Scene&, const std::vector<BodyMesh>&, std::vector<BuiltBody>&,
                                 Model<double, 3>&);

}  // namespace noli::integrator
