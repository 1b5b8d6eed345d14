// SPDX-License-Identifier: Apache-2.0
//
// A body made from what the scene says of it: mesh, places, masses, sets chosen. No forces yet.
#pragma once

#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/field.h"
#include "integrator/scene/shapes/shape.h"
#include "trajectory/formats/frames.h"

namespace noli::integrator {

struct BodyMesh {
  Shape shape;
  std::vector<Position> rest;   ///< X
  std::vector<Position> start;  ///< x before it is perturbed: what boxes choose among
  std::vector<double> mass;     ///< lumped: a third of a face, half of an edge, to each corner [kg]
  std::vector<VertexId> pinned;
};

/// Makes or reads a body's mesh. Throws InputError that names a field under /bodies/i: a file that does not load, a
/// cell with a vertex twice, faces or third coordinates in the plane, vertices without mass, a pin that is not there.
BodyMesh make_body(const Scene& scene, std::size_t index);

/// The frame in a file that the scene names at this field. Throws InputError: a file that does not load.
Frame load_frame(const Scene& scene, const std::string& file, const Field& at);

/// In the plane, throws InputError unless z = 0 at every vertex.
void require_plane(const Scene& scene, const std::vector<Position>& x, const Field& at);

/// The product of this factor over all patches that contain the point.
double patch_factor(const Body& body, const Position& x, double Patch::*which);

/// Middle of a cell at the start.
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
/// selection's field. Throws InputError: a vertex or a set that is not there, a box without vertices.
std::vector<VertexId> select(const Selection& selection, const Shape& shape, const std::vector<Position>& start,
                             const Field& at);

/// Closed.
bool contains(const Box& box, const Position& x);

}  // namespace noli::integrator
