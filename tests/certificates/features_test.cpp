// SPDX-License-Identifier: Apache-2.0
#include "certificates/features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace noli::certificates {
namespace {

using Ids = std::set<VertexId>;
using Pair = std::pair<Ids, Ids>;

/// All pairs of vertex-disjoint features that can meet, by the definition.
std::set<Pair> expected(const Mesh& mesh, int dimension) {
  std::set<Ids> edges, loose_edges, faces, vertices, points;
  for (const auto& f : mesh.faces) {
    faces.insert({f[0], f[1], f[2]});
    for (std::size_t k = 0; k < 3; ++k) {
      edges.insert({f[k], f[(k + 1) % 3]});
      vertices.insert({f[k]});
    }
  }
  for (const auto& e : mesh.edges) {
    edges.insert({e[0], e[1]});
    loose_edges.insert({e[0], e[1]});
    vertices.insert({{e[0]}, {e[1]}});
  }
  for (const VertexId p : mesh.points) {
    vertices.insert({p});
    points.insert({p});
  }
  std::set<Pair> result;
  const auto add = [&](const std::set<Ids>& a, const std::set<Ids>& b) {
    for (const Ids& x : a) {
      for (const Ids& y : b) {
        const bool disjoint = std::none_of(x.begin(), x.end(), [&](VertexId v) { return y.contains(v); });
        if (disjoint && (a != b || x < y)) result.insert({x, y});
      }
    }
  };
  add(points, points);
  if (dimension == 2) {
    add(vertices, edges);
    return result;
  }
  add(vertices, faces);
  add(edges, edges);
  add(points, loose_edges);
  // The end of a loose edge against a loose edge that it has a vertex in common with.
  for (const Ids& x : loose_edges) {
    for (const Ids& y : loose_edges) {
      for (const VertexId v : x) {
        const bool neighbours = std::any_of(x.begin(), x.end(), [&](VertexId w) { return y.contains(w); });
        if (neighbours && !y.contains(v)) result.insert({{v}, y});
      }
    }
  }
  return result;
}

void expect_each_once(const Mesh& mesh, int dimension) {
  const Features features(mesh, dimension);
  std::set<Pair> found;
  std::set<PairKey> keys;
  const auto cells = static_cast<std::uint32_t>(features.cells().size());
  for (std::uint32_t a = 0; a < cells; ++a) {
    for (std::uint32_t b = a + 1; b < cells; ++b) {
      features.for_each_pair(a, b, [&](const Stencil& s) {
        Ids first(s.vertices.begin(), s.vertices.begin() + static_cast<std::ptrdiff_t>(s.first()));
        Ids second(s.vertices.begin() + static_cast<std::ptrdiff_t>(s.first()),
                   s.vertices.begin() + static_cast<std::ptrdiff_t>(s.size()));
        if (s.kind == FeaturePair::edge_edge && second < first) std::swap(first, second);
        if (s.kind == FeaturePair::vertex_vertex && second < first) std::swap(first, second);
        EXPECT_TRUE(found.insert({first, second}).second);
        EXPECT_TRUE(keys.insert(s.key).second);
      });
    }
  }
  EXPECT_EQ(found, expected(mesh, dimension));
}

TEST(Features, PairsAreThoseOfTheDefinitionEachOnce) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 40; ++i) {
    Mesh mesh;
    mesh.vertex_count = 12;
    std::set<Ids> used;
    const auto three = [&] {
      Ids ids;
      while (ids.size() < 3) ids.insert(static_cast<VertexId>(random() % 9));
      return ids;
    };
    for (int f = 0; f < 5; ++f) {
      const Ids ids = three();
      if (!used.insert(ids).second) continue;
      mesh.faces.push_back({*ids.begin(), *std::next(ids.begin()), *std::next(ids.begin(), 2)});
    }
    // A chain and two points, which share no vertices with the rest except one end.
    mesh.edges = {{8, 9}, {9, 10}};
    mesh.points = {11};
    expect_each_once(mesh, 3);
  }
}

TEST(Features, InThePlaneVerticesMeetEdges) {
  Mesh mesh;
  mesh.vertex_count = 8;
  mesh.edges = {{0, 1}, {1, 2}, {2, 3}, {4, 5}};
  mesh.points = {6, 7};
  expect_each_once(mesh, 2);
}

TEST(Features, CellsOfAVertex) {
  Mesh mesh;
  mesh.vertex_count = 5;
  mesh.faces = {{0, 1, 2}, {1, 3, 2}};
  mesh.edges = {{3, 4}};
  const Features features(mesh, 3);
  const auto of_three = features.cells_of(3);
  EXPECT_EQ(std::vector<std::uint32_t>(of_three.begin(), of_three.end()), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(features.cells_of(0).size(), 1U);
}

}  // namespace
}  // namespace noli::certificates
