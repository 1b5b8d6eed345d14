// SPDX-License-Identifier: Apache-2.0
#include "bench/candidates.h"

#include <algorithm>
#include <cstddef>

namespace noli::bench {
namespace {

struct Box {
  Position lower, upper;
  std::uint32_t feature;
};

bool overlap_in_yz(const Box& a, const Box& b) {
  return a.lower[1] <= b.upper[1] && b.lower[1] <= a.upper[1] && a.lower[2] <= b.upper[2] && b.lower[2] <= a.upper[2];
}

class Sweep {
 public:
  Sweep(std::span<const Position> x_t0, std::span<const Position> x_t1) : x_t0_(x_t0), x_t1_(x_t1) {}

  /// Boxes of features over the step, sorted by their lower end in x.
  template <std::size_t N>
  std::vector<Box> boxes(const std::vector<std::array<VertexId, N>>& features) const {
    std::vector<Box> all;
    for (std::uint32_t i = 0; i < features.size(); ++i) all.push_back(box(features[i], i));
    std::sort(all.begin(), all.end(), [](const Box& a, const Box& b) { return a.lower[0] < b.lower[0]; });
    return all;
  }

 private:
  Box box(std::span<const VertexId> vertices, std::uint32_t feature) const {
    Box result{x_t0_[vertices[0]], x_t0_[vertices[0]], feature};
    for (const VertexId vertex : vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax(x_t0_[vertex][axis], x_t1_[vertex][axis]);
        result.lower[axis] = std::min(result.lower[axis], low);
        result.upper[axis] = std::max(result.upper[axis], high);
      }
    }
    return result;
  }

  std::span<const Position> x_t0_, x_t1_;
};

/// Calls found(i, j) for each pair of overlapping boxes of two sorted lists.
template <class Found>
void sweep_two(const std::vector<Box>& first, const std::vector<Box>& second, Found&& found) {
  // A pair overlaps in x iff one's lower end lies in the other's range; `strictly` breaks the tie of equal lower ends.
  const auto one_way = [&](const auto& outer, const auto& inner, bool strictly, auto&& report) {
    std::size_t begin = 0;
    for (const Box& a : outer) {
      const auto before = [&](const Box& b) { return strictly ? b.lower[0] <= a.lower[0] : b.lower[0] < a.lower[0]; };
      while (begin < inner.size() && before(inner[begin])) ++begin;
      for (std::size_t k = begin; k < inner.size() && inner[k].lower[0] <= a.upper[0]; ++k) {
        if (overlap_in_yz(a, inner[k])) report(a.feature, inner[k].feature);
      }
    }
  };
  one_way(first, second, false, found);
  one_way(second, first, true, [&](std::uint32_t j, std::uint32_t i) { found(i, j); });
}

template <class Found>
void sweep_one(const std::vector<Box>& boxes, Found&& found) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = i + 1; k < boxes.size() && boxes[k].lower[0] <= boxes[i].upper[0]; ++k) {
      if (overlap_in_yz(boxes[i], boxes[k])) found(boxes[i].feature, boxes[k].feature);
    }
  }
}

std::vector<std::array<VertexId, 2>> edges_of(const Mesh& mesh) {
  std::vector<std::array<VertexId, 2>> edges;
  for (const auto& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(face[k], face[(k + 1) % 3]);
      edges.push_back({a, b});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<std::array<VertexId, 1>> vertices_of(const Mesh& mesh) {
  std::vector<bool> used(mesh.vertex_count);
  for (const auto& face : mesh.faces) {
    for (const VertexId vertex : face) used[vertex] = true;
  }
  std::vector<std::array<VertexId, 1>> vertices;
  for (VertexId vertex = 0; vertex < mesh.vertex_count; ++vertex) {
    if (used[vertex]) vertices.push_back({vertex});
  }
  return vertices;
}

template <std::size_t N, std::size_t M>
bool share_vertex(const std::array<VertexId, N>& a, const std::array<VertexId, M>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](VertexId vertex) { return std::find(b.begin(), b.end(), vertex) != b.end(); });
}

}  // namespace

Candidates find_candidates(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1) {
  const Sweep sweep(x_t0, x_t1);
  const auto vertices = vertices_of(mesh);
  const auto edges = edges_of(mesh);
  Candidates candidates;
  sweep_two(sweep.boxes(vertices), sweep.boxes(mesh.faces), [&](std::uint32_t i, std::uint32_t j) {
    const auto& face = mesh.faces[j];
    if (!share_vertex(vertices[i], face)) candidates.vertex_face.push_back({vertices[i][0], face[0], face[1], face[2]});
  });
  sweep_one(sweep.boxes(edges), [&](std::uint32_t i, std::uint32_t j) {
    const auto &a = edges[std::min(i, j)], &b = edges[std::max(i, j)];
    if (!share_vertex(a, b)) candidates.edge_edge.push_back({a[0], a[1], b[0], b[1]});
  });
  return candidates;
}

}  // namespace noli::bench
