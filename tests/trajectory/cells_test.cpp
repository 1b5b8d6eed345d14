// SPDX-License-Identifier: Apache-2.0
#include "trajectory/cells.h"

#include <gtest/gtest.h>

namespace noli {
namespace {

using Faces = std::vector<std::array<VertexId, 3>>;
using Edges = std::vector<std::array<VertexId, 2>>;
using Points = std::vector<VertexId>;

TEST(Cells, PolygonIsAFanFromItsFirstCorner) {
  Mesh mesh{.vertex_count = 9, .faces = {}, .edges = {}, .points = {}};
  add_polygon(mesh, Points{7, 3, 4, 8, 2});
  EXPECT_EQ(mesh.faces, (Faces{{7, 3, 4}, {7, 4, 8}, {7, 8, 2}}));
  EXPECT_TRUE(mesh.edges.empty() && mesh.points.empty());
}

TEST(Cells, SmallPolygonsAreLooseEdgesAndPoints) {
  Mesh mesh{.vertex_count = 9, .faces = {}, .edges = {}, .points = {}};
  add_polygon(mesh, Points{5});
  add_polygon(mesh, Points{6, 1});
  add_polygon(mesh, Points{1, 2, 3});
  EXPECT_EQ(mesh.points, Points{5});
  EXPECT_EQ(mesh.edges, (Edges{{6, 1}}));
  EXPECT_EQ(mesh.faces, (Faces{{1, 2, 3}}));
}

TEST(Cells, EdgesOfFacesAndRepeatedOnesAreDropped) {
  Mesh mesh{
      .vertex_count = 9, .faces = {{0, 1, 2}}, .edges = {{1, 0}, {2, 3}, {0, 2}, {3, 2}, {2, 3}, {4, 4}}, .points = {}};
  drop_redundant_cells(mesh);
  EXPECT_EQ(mesh.edges, (Edges{{2, 3}, {4, 4}}));
  EXPECT_EQ(mesh.faces, (Faces{{0, 1, 2}}));
}

TEST(Cells, PointsOfLargerCellsAndRepeatedOnesAreDropped) {
  Mesh mesh{.vertex_count = 9, .faces = {{0, 1, 2}}, .edges = {{3, 4}}, .points = {8, 1, 4, 7, 8}};
  drop_redundant_cells(mesh);
  EXPECT_EQ(mesh.points, (Points{8, 7}));
}

TEST(Cells, EqualFacesStay) {
  Mesh mesh{.vertex_count = 3, .faces = {{0, 1, 2}, {0, 1, 2}}, .edges = {}, .points = {}};
  drop_redundant_cells(mesh);
  EXPECT_EQ(mesh.faces.size(), 2u);
}

TEST(Cells, UnreferencedVertices) {
  const Mesh mesh{.vertex_count = 8, .faces = {{0, 1, 2}}, .edges = {{4, 2}}, .points = {6}};
  EXPECT_EQ(unreferenced_vertices(mesh), (Points{3, 5, 7}));
  EXPECT_TRUE(unreferenced_vertices(Mesh{.vertex_count = 1, .faces = {}, .edges = {}, .points = {0}}).empty());
}

TEST(Cells, HeldAreThoseOfHeldVerticesOnly) {
  const Mesh mesh{.vertex_count = 7, .faces = {{2, 0, 1}, {1, 2, 3}}, .edges = {{4, 5}, {3, 4}}, .points = {6, 3}};
  EXPECT_EQ(held_cells(mesh, std::vector<std::uint8_t>{1, 1, 1, 0, 1, 1, 1}), (Points{2, 4, 6}));
  EXPECT_EQ(held_cells(mesh, std::vector<std::uint8_t>{1, 1, 0, 0, 1, 0, 0}), Points{});
}

}  // namespace
}  // namespace noli
