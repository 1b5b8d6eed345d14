// SPDX-License-Identifier: Apache-2.0
//
// Merges vertices that are at the same place at all times. It happens only on request, and reports say how many.
//
// It takes two passes over the frames. The first finds the classes of vertices whose coordinates are equal as numbers
// (-0 is 0) in every frame, by splitting the classes frame by frame. The second is the verification itself, on a mesh
// that refers to the first vertex of each class.
//
// Memory is linear in the number of vertices. Equality is decided by comparing coordinates; hashes only find
// candidates.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <noli/mesh.h>

namespace noli {

/// Classes of vertices that were at the same place in all frames seen so far.
class IdenticalVertices {
 public:
  /// Before the first frame all vertices are in one class.
  explicit IdenticalVertices(std::size_t vertex_count) : representative_(vertex_count, 0) {}

  /// Splits the classes by the positions of one more frame. Precondition: vertex_count finite positions.
  void refine(std::span<const Position> positions);

  /// For each vertex the smallest index of its class.
  const std::vector<VertexId>& representative() const { return representative_; }
  /// How many vertices are represented by another one.
  std::size_t merged_count() const;

 private:
  std::vector<VertexId> representative_;
};

/// The mesh with every index replaced by its representative. vertex_count stays, so positions need no change. Vertices
/// that were merged into others are then unreferenced, so call unreferenced_vertices() first. A cell in which an index
/// now occurs twice stays, degenerate; loose edges and points that became redundant are dropped (cells.h).
Mesh with_merged_vertices(const Mesh& mesh, const IdenticalVertices& classes);

}  // namespace noli
