// SPDX-License-Identifier: Apache-2.0
#include "trajectory/cells.h"
#include "trajectory/stop.h"

#include <algorithm>
#include <iterator>
#include <unordered_set>

namespace noli {
namespace {

/// Equal for an edge and its reverse, different for all others.
std::uint64_t edge_key(VertexId a, VertexId b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

void drop_redundant_edges(Mesh& mesh) {
  std::unordered_set<std::uint64_t> known;
  known.reserve(2 * mesh.faces.size() + mesh.edges.size());
  for (const auto& [a, b, c] : mesh.faces) {
    end_if_stopped();
    known.insert({edge_key(a, b), edge_key(b, c), edge_key(c, a)});
  }
  std::erase_if(mesh.edges, [&](const auto& edge) { return !known.insert(edge_key(edge[0], edge[1])).second; });
}

/// Whether each vertex is a corner of a face or an end of a loose edge.
std::vector<bool> used_by_larger_cells(const Mesh& mesh) {
  std::vector<bool> used(mesh.vertex_count, false);
  for (const auto& face : mesh.faces) {
    for (const VertexId v : face) used[v] = true;
  }
  for (const auto& edge : mesh.edges) {
    for (const VertexId v : edge) used[v] = true;
  }
  return used;
}

void drop_redundant_points(Mesh& mesh) {
  std::vector<bool> used = used_by_larger_cells(mesh);
  std::erase_if(mesh.points, [&](VertexId v) {
    const bool redundant = used[v];
    used[v] = true;
    return redundant;
  });
}

}  // namespace

void add_polygon(Mesh& mesh, std::span<const VertexId> corners) {
  if (corners.size() == 1) mesh.points.push_back(corners[0]);
  if (corners.size() == 2) mesh.edges.push_back({corners[0], corners[1]});
  for (std::size_t i = 2; i < corners.size(); ++i) mesh.faces.push_back({corners[0], corners[i - 1], corners[i]});
}

void drop_redundant_cells(Mesh& mesh) {
  if (!mesh.edges.empty()) drop_redundant_edges(mesh);
  if (!mesh.points.empty()) drop_redundant_points(mesh);
}

void append_mesh(Mesh& mesh, const Mesh& other) {
  const auto shift = static_cast<VertexId>(mesh.vertex_count);
  for (const auto& [a, b, c] : other.faces) mesh.faces.push_back({a + shift, b + shift, c + shift});
  for (const auto& [a, b] : other.edges) mesh.edges.push_back({a + shift, b + shift});
  for (const VertexId v : other.points) mesh.points.push_back(v + shift);
  mesh.vertex_count += other.vertex_count;
}

std::vector<VertexId> unreferenced_vertices(const Mesh& mesh) {
  std::vector<bool> used = used_by_larger_cells(mesh);
  for (const VertexId v : mesh.points) used[v] = true;
  std::vector<VertexId> result;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) result.push_back(static_cast<VertexId>(v));
  }
  return result;
}

void add_particles(Mesh& mesh) {
  const std::vector<VertexId> loose = unreferenced_vertices(mesh);
  mesh.points.insert(mesh.points.end(), loose.begin(), loose.end());
}

std::vector<VertexId> drop_unreferenced_vertices(Mesh& mesh) {
  const std::vector<VertexId> unused = unreferenced_vertices(mesh);
  std::vector<VertexId> kept, number(mesh.vertex_count, 0);
  for (VertexId v = 0; v < mesh.vertex_count; ++v) {
    if (std::binary_search(unused.begin(), unused.end(), v)) continue;
    number[v] = static_cast<VertexId>(kept.size());
    kept.push_back(v);
  }
  const auto rename = [&](VertexId& v) { v = number[v]; };
  for (auto& face : mesh.faces) std::for_each(face.begin(), face.end(), rename);
  for (auto& edge : mesh.edges) std::for_each(edge.begin(), edge.end(), rename);
  std::for_each(mesh.points.begin(), mesh.points.end(), rename);
  mesh.vertex_count = kept.size();
  return kept;
}

std::vector<VertexId> held_cells(const Mesh& mesh, std::span<const std::uint8_t> held) {
  std::vector<VertexId> first;
  const auto look = [&](const auto& cells) {
    for (const auto& cell : cells) {
      if (std::all_of(cell.begin(), cell.end(), [&](VertexId v) { return held[v] != 0; })) first.push_back(cell[0]);
    }
  };
  look(mesh.faces);
  look(mesh.edges);
  std::copy_if(mesh.points.begin(), mesh.points.end(), std::back_inserter(first),
               [&](VertexId v) { return held[v] != 0; });
  return first;
}

}  // namespace noli
