// SPDX-License-Identifier: Apache-2.0
#include "trajectory/cell_features.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace noli {

namespace {

/// One place where a set of N vertices (in ascending order) occurs as a feature.
template <std::size_t N>
struct Occurrence {
  std::array<VertexId, N> vertices;
  std::uint32_t cell;
  FeatureMask bit;

  /// Whether a has the lesser vertices, ignoring the first. (Comparisons of std::array call memcmp, which is slow for
  /// so few bytes.)
  friend bool less_after_first(const Occurrence& a, const Occurrence& b) {
    for (std::size_t i = 1; i < N; ++i) {
      if (a.vertices[i] != b.vertices[i]) return a.vertices[i] < b.vertices[i];
    }
    return false;
  }

  friend bool same_vertices(const Occurrence& a, const Occurrence& b) {
    bool same = true;
    for (std::size_t i = 0; i < N; ++i) same = same && a.vertices[i] == b.vertices[i];
    return same;
  }
};

/// Sorts occurrences with the same least vertex by the other vertices. Stable.
template <std::size_t N>
void sort_bucket(std::span<Occurrence<N>> bucket) {
  constexpr std::size_t few = 24;
  const auto less = [](const Occurrence<N>& a, const Occurrence<N>& b) { return less_after_first(a, b); };
  if (bucket.size() > few) return std::stable_sort(bucket.begin(), bucket.end(), less);
  for (std::size_t i = 1; i < bucket.size(); ++i) {
    const Occurrence<N> moved = bucket[i];
    std::size_t j = i;
    for (; j > 0 && less(moved, bucket[j - 1]); --j) bucket[j] = bucket[j - 1];
    bucket[j] = moved;
  }
}

/// All occurrences sorted by vertices, then cell, then bit. `visit(add)` calls add for each of them, by cell, then bit.
template <std::size_t N, class Visit>
std::vector<Occurrence<N>> sorted_occurrences(std::size_t vertex_count, const Visit& visit) {
  std::vector<std::size_t> begin(vertex_count + 1, 0);  // of the bucket of each least vertex, after partial_sum
  visit([&](const Occurrence<N>& o) { ++begin[o.vertices[0] + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Occurrence<N>> sorted(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  visit([&](const Occurrence<N>& o) { sorted[next[o.vertices[0]]++] = o; });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    sort_bucket(std::span(sorted).subspan(begin[v], begin[v + 1] - begin[v]));
  }
  return sorted;
}

/// `run`: all occurrences of one set of vertices, in order. The first one owns it; with `yields`, the first of a cell
/// that does not yield, if there is one.
template <std::size_t N>
void assign(std::span<const Occurrence<N>> run, const std::vector<bool>& yields, CellFeatures& features) {
  auto owner = run.begin();
  if (!yields.empty()) {
    owner = std::find_if_not(run.begin(), run.end(), [&](const auto& o) { return yields[o.cell]; });
    if (owner == run.end()) owner = run.begin();
  }
  features.owned[owner->cell] |= owner->bit;
  if (run.front().cell == run.back().cell) return;
  for (const auto& o : run) features.shared[o.cell] |= o.bit;
}

/// `visit` as in sorted_occurrences.
template <std::size_t N, class Visit>
void assign_all(std::size_t vertex_count, const Visit& visit, const std::vector<bool>& yields, CellFeatures& features) {
  const auto all = sorted_occurrences<N>(vertex_count, visit);
  const std::span<const Occurrence<N>> view(all);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && same_vertices(all[end], all[begin])) ++end;
    assign(view.subspan(begin, end - begin), yields, features);
  }
}

void assign_corners(const Mesh& mesh, const std::vector<bool>& yields, CellFeatures& features) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  struct Place {
    std::uint32_t cell = none;
    FeatureMask bit = 0;
  };
  struct Places {
    Place first, owner;
  };
  std::vector<Places> places(mesh.vertex_count);
  const auto cells = static_cast<std::uint32_t>(mesh.cell_count());
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    const auto vertices = corners(mesh, cell);
    for (int i = 0; i < corner_count(mesh, cell); ++i) {
      const Place here{cell, corner_bit(i)};
      auto& [first, owner] = places[vertices[static_cast<std::size_t>(i)]];
      if (first.cell == none) {
        first = owner = here;
      } else if (first.cell != cell) {
        features.shared[cell] |= here.bit;
        features.shared[first.cell] |= first.bit;
        if (!yields.empty() && yields[owner.cell] && !yields[cell]) owner = here;
      }
    }
  }
  for (const auto& [first, owner] : places) {
    if (first.cell != none) features.owned[owner.cell] |= owner.bit;
  }
}

void assign_edges(const Mesh& mesh, const std::vector<bool>& yields, CellFeatures& features) {
  const auto edge = [](VertexId a, VertexId b, std::size_t cell, int number) {
    return Occurrence<2>{{std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(cell), edge_bit(number)};
  };
  const auto visit = [&mesh, edge](const auto& add) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& v = mesh.faces[f];
      add(edge(v[0], v[1], f, 0));
      add(edge(v[1], v[2], f, 1));
      add(edge(v[2], v[0], f, 2));
    }
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
      add(edge(mesh.edges[e][0], mesh.edges[e][1], mesh.faces.size() + e, 0));
    }
  };
  assign_all<2>(mesh.vertex_count, visit, yields, features);
}

/// Marks the listed cells among [first, last), which are all of one kind.
void assign_cells(const Mesh& mesh, std::size_t first, std::size_t last, CellFeatures& features) {
  if (first == last) return;
  const auto visit = [&mesh, first, last](const auto& add) {
    for (std::size_t i = first; i < last; ++i) {
      const auto cell = static_cast<std::uint32_t>(i);
      add(Occurrence<3>{ascending(corners(mesh, cell), corner_count(mesh, cell)), cell, cell_bit});
    }
  };
  assign_all<3>(mesh.vertex_count, visit, {}, features);
}

}  // namespace

std::array<VertexId, 3> ascending(std::array<VertexId, 3> v, int count) {
  if (v[1] < v[0]) std::swap(v[0], v[1]);
  if (count < 3) return {v[0], v[1], v[1]};
  if (v[2] < v[1]) std::swap(v[1], v[2]);
  if (v[1] < v[0]) std::swap(v[0], v[1]);
  return v;
}

CellFeatures find_owners(const Mesh& mesh, bool list_cells, const std::vector<bool>& yields) {
  const std::size_t faces = mesh.faces.size(), edges = mesh.edges.size();
  CellFeatures features;
  features.owned.assign(mesh.cell_count(), 0);
  features.shared.assign(mesh.cell_count(), 0);
  assign_corners(mesh, yields, features);
  assign_edges(mesh, yields, features);
  if (list_cells) {
    assign_cells(mesh, 0, faces, features);
    assign_cells(mesh, faces, faces + edges, features);
  }
  return features;
}

}  // namespace noli
