// SPDX-License-Identifier: Apache-2.0
//
// Finds short paths along a mesh, for the ring rule: features joined by a path of fewer than K edges may be nearer than
// the least distance.
//
// Notation
//   K       the ring, at least 1
//   step    an edge of a path: the cell that has both of its ends, and the end
//
// With K = 1 the only paths are from a vertex to itself, and nothing is stored.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <noli/mesh.h>

namespace noli {

class MeshPaths {
 public:
  using Steps = std::vector<std::array<std::uint32_t, 2>>;

  MeshPaths(const Mesh& mesh, std::uint32_t ring);

  /// A shortest path from v to w, of fewer than K edges; nothing if there is none.
  std::optional<Steps> find(VertexId v, VertexId w) const;

 private:
  const Mesh& mesh_;
  std::uint32_t ring_;
  std::vector<std::uint32_t> begin_, cells_;  ///< those of vertex v are cells_[begin_[v]] to cells_[begin_[v + 1]]
};

}  // namespace noli
