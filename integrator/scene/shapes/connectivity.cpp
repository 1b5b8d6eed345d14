// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/connectivity.h"
#include "trajectory/stop.h"

#include <algorithm>
#include <compare>
#include <utility>

namespace noli::integrator {
namespace {

/// One side of a face. `order` counts them in the order of the faces.
struct Side {
  VertexId low, high;
  std::uint32_t order;

  auto operator<=>(const Side&) const = default;
};

std::vector<Side> sorted_sides(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.faces.size());
  for (const auto& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(face[k], face[(k + 1) % 3]);
      sides.push_back({low, high, static_cast<std::uint32_t>(sides.size())});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    end_if_stopped();
    return a < b;
  });
  return sides;
}

VertexId opposite(const Mesh& mesh, const Side& side) { return mesh.faces[side.order / 3][(side.order + 2) % 3]; }

}  // namespace

std::vector<FaceEdge> face_edges(const Mesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<std::pair<std::uint32_t, FaceEdge>> found;  // with the order of the first side
  for (const Side& side : sides) {
    end_if_stopped();
    const auto& face = mesh.faces[side.order / 3];
    FaceEdge* last = found.empty() ? nullptr : &found.back().second;
    if (last != nullptr && std::minmax(last->ends[0], last->ends[1]) == std::minmax(side.low, side.high)) {
      if (last->count == 1) {
        last->opposite[1] = opposite(mesh, side);
        last->faces[1] = side.order / 3;
      }
      ++last->count;
    } else {
      found.push_back(
          {side.order,
           {{face[side.order % 3], face[(side.order + 1) % 3]}, {opposite(mesh, side), 0}, {side.order / 3, 0}, 1}});
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    end_if_stopped();
    return a.first < b.first;
  });
  std::vector<FaceEdge> edges;
  edges.reserve(found.size());
  for (const auto& edge : found) edges.push_back(edge.second);
  return edges;
}

Joints joints(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> at(mesh.vertex_count);
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    end_if_stopped();
    for (const VertexId end : mesh.edges[e]) at[end].push_back(e);
  }
  const auto other_end = [&mesh](std::uint32_t e, VertexId v) { return mesh.edges[e][mesh.edges[e][0] == v ? 1 : 0]; };
  Joints result;
  for (VertexId v = 0; v < mesh.vertex_count; ++v) {
    end_if_stopped();
    if (at[v].size() > 2) ++result.branchings;
    if (at[v].size() == 2) {
      result.joints.push_back({{other_end(at[v][0], v), v, other_end(at[v][1], v)}, {at[v][0], at[v][1]}});
    }
  }
  return result;
}

void append(Mesh& mesh, const Mesh& more) {
  const auto first = static_cast<VertexId>(mesh.vertex_count);
  const auto append_cells = [first](auto& cells, const auto& added) {
    for (auto cell : added) {
      end_if_stopped();
      for (VertexId& i : cell) i += first;
      cells.push_back(cell);
    }
  };
  append_cells(mesh.faces, more.faces);
  append_cells(mesh.edges, more.edges);
  for (const VertexId i : more.points) mesh.points.push_back(first + i);
  mesh.vertex_count += more.vertex_count;
}

}  // namespace noli::integrator
