// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "proofs/prover/windows/forest.h"
#include "sheets.h"

namespace noli::testing {
namespace {

Forest forest_of(const Surface& surface, int dimension = 3) {
  WindowOptions options;
  options.dimension = dimension;
  return {surface.mesh, surface.x, options};
}

Group leaf_at(std::size_t i) { return {0, static_cast<std::uint32_t>(i), 1}; }

std::uint32_t chart_of_leaf(const Forest& forest, std::size_t leaf) { return forest.charts().chart_of(leaf_at(leaf)); }

/// The share of leaves that have a chart.
double covered(const Forest& forest) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < forest.leaves().size(); ++i) count += chart_of_leaf(forest, i) != Charts::none ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(forest.leaves().size());
}

bool share_vertex(const Leaf& a, const Leaf& b) {
  return std::any_of(a.vertices.begin(), a.vertices.end(), [&](VertexId v) {
    return std::find(b.vertices.begin(), b.vertices.end(), v) != b.vertices.end();
  });
}

/// n by n squares with a hole in the middle, a third as wide.
Surface holed(std::uint32_t n) {
  Surface surface = grid(n, n);
  const std::uint32_t low = n / 3, high = 2 * n / 3;
  std::erase_if(surface.mesh.faces, [&](const auto& f) {
    return std::all_of(f.begin(), f.end(), [&](VertexId v) {
      const Position& x = surface.x[v];
      return x[0] >= low && x[0] <= high && x[1] >= low && x[1] <= high;
    });
  });
  return surface;
}

TEST(Charts, CoverMostOfAClosedSurface) {
  const Forest forest = forest_of(closed_box(12));
  EXPECT_FALSE(forest.trees()[0].sheet);
  EXPECT_GT(covered(forest), 0.6);
}

TEST(Charts, HoldTheirGroupAndAllNextToIt) {
  const Forest forest = forest_of(closed_box(10));
  const auto& leaves = forest.leaves();
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const std::uint32_t chart = chart_of_leaf(forest, i);
    if (chart == Charts::none) continue;
    std::set<std::array<VertexId, 3>> faces;
    for (const LaidFace& face : forest.charts().faces(chart)) {
      EXPECT_TRUE(face.usable);
      faces.insert(face.vertices);
    }
    for (std::size_t j = 0; j < leaves.size(); ++j) {
      const bool held = forest.charts().covers(chart, leaf_at(j));
      if (share_vertex(leaves[i], leaves[j])) {
        EXPECT_TRUE(held);
      }
      if (held) {
        EXPECT_TRUE(faces.contains(leaves[j].vertices));
      } else {
        ++beyond;
      }
    }
  }
  EXPECT_GT(beyond, 0u);
}

TEST(Charts, OfGroupsAreThoseOfTheirLeaves) {
  const Forest forest = forest_of(closed_box(8));
  const Group root = forest.trees()[0].root;
  EXPECT_EQ(forest.charts().chart_of(root), Charts::none);
  std::size_t with = 0;
  const auto look = [&](auto&& self, Group g) -> void {
    const std::uint32_t chart = forest.charts().chart_of(g);
    if (chart != Charts::none) {
      ++with;
      EXPECT_TRUE(forest.charts().covers(chart, g));
      EXPECT_EQ(chart_of_leaf(forest, g.begin), chart);
      EXPECT_EQ(chart_of_leaf(forest, g.begin + g.count - 1), chart);
    }
    if (g.is_leaf()) return;
    self(self, g.left());
    self(self, g.right());
  };
  look(look, root);
  EXPECT_GT(with, forest.charts().size());
  for (std::size_t c = 0; c < forest.charts().size(); ++c) {
    EXPECT_FALSE(forest.charts().covers(static_cast<std::uint32_t>(c), root));
  }
}

/// Except from the straight border of the rectangle.
TEST(Charts, KeepAwayFromBorders) {
  const Surface straight = holed(18);
  Surface surface = straight;
  turn(surface, 0.3, 0.1, -0.2);
  const Forest forest = forest_of(surface);
  EXPECT_FALSE(forest.trees()[0].sheet);
  EXPECT_GT(covered(forest), 0.1);
  EXPECT_GT(covered(forest_of(straight)), covered(forest));
  EXPECT_GT(covered(forest_of(straight, 2)), 0.1);
  const auto on_border = [&](VertexId v) {
    const Position& x = straight.x[v];
    return x[0] == 0 || x[0] == 18 || x[1] == 0 || x[1] == 18;
  };
  for (std::size_t i = 0; i < forest.leaves().size(); ++i) {
    const auto& v = forest.leaves()[i].vertices;
    if (std::any_of(v.begin(), v.end(), on_border)) {
      EXPECT_EQ(chart_of_leaf(forest, i), Charts::none);
    }
  }
}

TEST(Charts, NeedFacesThatAreOrientedAlike) {
  Surface surface = closed_box(8);
  for (auto& face : surface.mesh.faces) {
    if (face[0] % 2 == 0) std::swap(face[0], face[1]);
  }
  EXPECT_EQ(forest_of(surface).charts().size(), 0u);
}

TEST(Charts, NeedAnEdgeToHaveTwoFaces) {
  Surface surface = closed_box(8);
  const double before = covered(forest_of(surface));
  const std::size_t faces = surface.mesh.faces.size();
  for (std::size_t f = 0; f < faces; f += 7) surface.mesh.faces.push_back(surface.mesh.faces[f]);
  EXPECT_LT(covered(forest_of(surface)), before / 2);
}

/// Two layers above each other belong to one part: groups with faces of both have no chart.
TEST(Charts, NeedOneLayer) {
  Surface surface = holed(18);
  const Surface other = surface;
  append(surface, other, {0, 0, 0.01});
  surface.mesh.faces.push_back({0, 1, 361});  // joins them
  const Forest forest = forest_of(surface);
  for (std::size_t c = 0; c < forest.charts().size(); ++c) {
    std::set<bool> layers;
    for (const LaidFace& face : forest.charts().faces(c)) layers.insert(face.vertices[0] >= 361);
    EXPECT_EQ(layers.size(), 1u);
  }
}

}  // namespace
}  // namespace noli::testing
