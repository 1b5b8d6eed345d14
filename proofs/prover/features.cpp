// SPDX-License-Identifier: Apache-2.0
#include "noli/proofs/prover/features.h"

#include <algorithm>
#include <span>

namespace noli {

namespace {

/// One place where a set of N vertices (in ascending order) occurs as a feature.
template <std::size_t N>
struct Occurrence {
  std::array<VertexId, N> vertices;
  std::uint32_t cell;
  FeatureMask bit;

  /// -1, 0 or 1. (The comparisons of std::array are calls of memcmp, which is slow for so little.)
  friend int compare(const Occurrence& a, const Occurrence& b) {
    for (std::size_t i = 0; i < N; ++i) {
      if (a.vertices[i] != b.vertices[i]) return a.vertices[i] < b.vertices[i] ? -1 : 1;
    }
    return 0;
  }
  friend bool operator<(const Occurrence& a, const Occurrence& b) {
    const int order = compare(a, b);
    if (order != 0) return order < 0;
    return a.cell != b.cell ? a.cell < b.cell : a.bit < b.bit;
  }
};

/// Sorts by vertices, then cell, then bit: first into buckets by the least vertex, then within each of them.
template <std::size_t N>
void sort_occurrences(std::vector<Occurrence<N>>& all, std::size_t vertex_count) {
  std::vector<std::size_t> begin(vertex_count + 1, 0);
  for (const auto& o : all) ++begin[o.vertices[0] + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
  std::vector<Occurrence<N>> sorted(all.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const auto& o : all) sorted[next[o.vertices[0]]++] = o;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin[v]),
              sorted.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]));
  }
  all = std::move(sorted);
}

/// `run`: all occurrences of one set of vertices, in order. The first one owns it.
template <std::size_t N>
void assign(std::span<const Occurrence<N>> run, CellFeatures& features) {
  features.owned[run.front().cell] |= run.front().bit;
  if (run.front().cell == run.back().cell) return;
  for (const auto& o : run) features.shared[o.cell] |= o.bit;
}

template <std::size_t N>
void assign_all(std::vector<Occurrence<N>> all, std::size_t vertex_count, CellFeatures& features) {
  sort_occurrences(all, vertex_count);
  const std::span<const Occurrence<N>> view(all);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && compare(all[end], all[begin]) == 0) ++end;
    assign(view.subspan(begin, end - begin), features);
  }
}

void assign_corners(const Mesh& mesh, CellFeatures& features) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  struct First {
    std::uint32_t cell = none;
    FeatureMask bit = 0;
  };
  std::vector<First> first(mesh.vertex_count);
  const auto cells = static_cast<std::uint32_t>(mesh.cell_count());
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    const auto vertices = corners(mesh, cell);
    for (int i = 0; i < corner_count(mesh, cell); ++i) {
      First& f = first[vertices[static_cast<std::size_t>(i)]];
      if (f.cell == none) {
        f = {cell, corner_bit(i)};
        features.owned[cell] |= f.bit;
      } else if (f.cell != cell) {
        features.shared[cell] |= corner_bit(i);
        features.shared[f.cell] |= f.bit;
      }
    }
  }
}

void assign_edges(const Mesh& mesh, CellFeatures& features) {
  std::vector<Occurrence<2>> all;
  all.reserve(3 * mesh.faces.size() + mesh.edges.size());
  const auto add = [&all](VertexId a, VertexId b, std::size_t cell, int edge) {
    all.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(cell), edge_bit(edge)});
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& v = mesh.faces[f];
    add(v[0], v[1], f, 0);
    add(v[1], v[2], f, 1);
    add(v[2], v[0], f, 2);
  }
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) add(mesh.edges[e][0], mesh.edges[e][1], mesh.faces.size() + e, 0);
  assign_all(std::move(all), mesh.vertex_count, features);
}

/// The corners of a cell in ascending order; a loose edge or point repeats its last one.
std::array<VertexId, 3> ascending(std::array<VertexId, 3> v, int count) {
  if (v[1] < v[0]) std::swap(v[0], v[1]);
  if (count < 3) return {v[0], v[1], v[1]};
  if (v[2] < v[1]) std::swap(v[1], v[2]);
  if (v[1] < v[0]) std::swap(v[0], v[1]);
  return v;
}

/// Marks the listed ones among the cells [first, last), all of one kind.
void assign_cells(const Mesh& mesh, std::size_t first, std::size_t last, CellFeatures& features) {
  std::vector<Occurrence<3>> all;
  all.reserve(last - first);
  for (std::size_t i = first; i < last; ++i) {
    const auto cell = static_cast<std::uint32_t>(i);
    all.push_back({ascending(corners(mesh, cell), corner_count(mesh, cell)), cell, cell_bit});
  }
  assign_all(std::move(all), mesh.vertex_count, features);
}

}  // namespace

CellFeatures find_owners(const Mesh& mesh, bool list_faces) {
  const std::size_t faces = mesh.faces.size(), edges = mesh.edges.size();
  CellFeatures features;
  features.owned.assign(mesh.cell_count(), 0);
  features.shared.assign(mesh.cell_count(), 0);
  assign_corners(mesh, features);
  assign_edges(mesh, features);
  if (list_faces) assign_cells(mesh, 0, faces, features);
  assign_cells(mesh, faces, faces + edges, features);
  assign_cells(mesh, faces + edges, mesh.cell_count(), features);
  return features;
}

}  // namespace noli
