// SPDX-License-Identifier: Apache-2.0
//
// Finds the places of a mesh's forces: edges of faces, pairs of faces at an edge, pairs of loose edges at a vertex.
// Also joins meshes.
#pragma once

#include <array>
#include <vector>

#include <noli/mesh.h>

namespace noli::integrator {

/// An edge of faces, with the first two of them.
struct FaceEdge {
  std::array<VertexId, 2> ends{};      ///< in the order of the first face
  std::array<VertexId, 2> opposite{};  ///< the third vertex of the first and of the second face
  std::array<std::uint32_t, 2> faces{};
  std::uint32_t count = 0;  ///< of faces: 1 at the border, 2 inside, more where sheets meet
};

/// The edges of faces, in the order in which faces first mention them. Precondition: no face has a vertex twice.
std::vector<FaceEdge> face_edges(const Mesh& mesh);

/// A vertex at which exactly two loose edges meet: a, middle, b; a belongs to the edge that comes first.
struct Joint {
  std::array<VertexId, 3> vertices{};
  std::array<std::uint32_t, 2> edges{};
};

struct Joints {
  std::vector<Joint> joints;   ///< by their middles
  std::size_t branchings = 0;  ///< vertices with more than two loose edges
};

/// Precondition: no edge has a vertex twice.
Joints joints(const Mesh& mesh);

/// Adds the vertices and cells of another mesh; its vertices come after the existing ones.
void append(Mesh& mesh, const Mesh& more);

}  // namespace noli::integrator
