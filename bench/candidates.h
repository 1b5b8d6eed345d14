// SPDX-License-Identifier: Apache-2.0
//
// What a broad phase hands to the narrow phase: pairs of features that share no vertex and whose boxes over the step
// overlap (closed boxes around both positions of each point). Found by sorting along x and sweeping; exact comparisons,
// no inflation.
//
// What this does not do: it is no fast broad phase, and no part of what ships.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include <noli/query.h>

namespace noli::bench {

/// Vertex ids in the order of include/noli/query.h.
using Candidate = std::array<VertexId, 4>;

struct Candidates {
  std::vector<Candidate> vertex_face;  ///< vertices of faces against faces
  std::vector<Candidate> edge_edge;    ///< edges of faces, each once, against each other
};

Candidates find_candidates(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1);

template <class Query>
Query query_of(const Candidate& candidate, std::span<const Position> x_t0, std::span<const Position> x_t1) {
  Query query;
  for (std::size_t i = 0; i < 4; ++i) {
    query.x_t0[i] = x_t0[candidate[i]];
    query.x_t1[i] = x_t1[candidate[i]];
  }
  return query;
}

}  // namespace noli::bench
