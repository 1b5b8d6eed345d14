// SPDX-License-Identifier: Apache-2.0
//
// Makes a body from the scene: mesh, positions, masses, chosen sets. Forces are added later.
#pragma once

#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/field.h"
#include "integrator/scene/shapes/shape.h"
#include "trajectory/formats/frames.h"

namespace noli::integrator {

struct BodyMesh {
  Shape shape;
  std::vector<Position> rest;   ///< X
  std::vector<Position> start;  ///< x before it is perturbed; boxes choose among these
  std::vector<double> mass;     ///< lumped: each corner gets a third of a face, half of an edge [kg]
  std::vector<VertexId> pinned;
};

/// Makes or reads a body's mesh. Throws an InputError that names a field under /bodies/i: a file that does not load, a
/// cell with a vertex twice, faces or third coordinates in dimension 2, vertices without mass, an unknown pin.
BodyMesh make_body(const Scene& scene, std::size_t index);

/// The frame in a file that the scene names at this field. Throws InputError: a file that does not load.
Frame load_frame(const Scene& scene, const std::string& file, const Field& at);

/// In dimension 2, throws InputError unless z = 0 at every vertex.
void require_plane(const Scene& scene, const std::vector<Position>& x, const Field& at);

/// The product of a factor over all patches that contain the point.
double patch_factor(const Body& body, const Position& x, double Patch::*which);

/// The middle of a cell at the start.
template <std::size_t N>
Position centre(const std::vector<Position>& x, const std::array<VertexId, N>& cell) {
  Position sum{};
  for (const VertexId i : cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += x[i][axis];
  }
  for (double& coordinate : sum) coordinate /= N;
  return sum;
}

/// The whole document of a scene.
inline Field field_of(const Scene& scene) { return {scene.document, scene.path.string()}; }
/// The field of a body.
inline Field field_of_body(const Scene& scene, std::size_t body) { return field_of(scene)["bodies"][body]; }

/// Vertices by their numbers in the body, ascending, each once. Boxes choose among the start positions. `at` is the
/// selection's field. Throws InputError: an unknown vertex or set, a box without vertices.
std::vector<VertexId> select(const Selection& selection, const Shape& shape, const std::vector<Position>& start,
                             const Field& at);

/// Whether the closed box contains the point.
bool contains(const Box& box, const Position& x);

}  // namespace noli::integrator
