// SPDX-License-Identifier: Apache-2.0
#include "trajectory/cell_features.h"

#include <gtest/gtest.h>

namespace noli {
namespace {

TEST(CellFeatures, TheLeastCellOwns) {
  Mesh mesh;
  mesh.vertex_count = 5;
  mesh.faces = {{0, 1, 2}, {2, 1, 3}};
  mesh.edges = {{3, 2}, {3, 4}};
  mesh.points = {4};
  const CellFeatures features = find_owners(mesh, true);
  EXPECT_EQ(features.owned[0], 7 | 7 << 3 | cell_bit);
  EXPECT_EQ(features.owned[1], corner_bit(2) | edge_bit(1) | edge_bit(2) | cell_bit);  // 3, (1, 3), (3, 2)
  EXPECT_EQ(features.owned[2], cell_bit);
  EXPECT_EQ(features.owned[3], corner_bit(1) | edge_bit(0) | cell_bit);
  EXPECT_EQ(features.owned[4], 0);
}

TEST(CellFeatures, WhatSeveralCellsHaveIsShared) {
  Mesh mesh;
  mesh.vertex_count = 5;
  mesh.faces = {{0, 1, 2}, {2, 1, 3}};
  mesh.points = {4};
  const CellFeatures features = find_owners(mesh, false);
  EXPECT_EQ(features.shared[0], corner_bit(1) | corner_bit(2) | edge_bit(1));
  EXPECT_EQ(features.shared[1], corner_bit(0) | corner_bit(1) | edge_bit(0));
  EXPECT_EQ(features.shared[2], 0);
}

TEST(CellFeatures, AVertexThatACellHasTwiceCountsOnce) {
  Mesh mesh;
  mesh.vertex_count = 2;
  mesh.faces = {{0, 1, 1}};
  const CellFeatures features = find_owners(mesh, false);
  EXPECT_EQ(features.owned[0], corner_bit(0) | corner_bit(1) | edge_bit(0) | edge_bit(1));
  EXPECT_EQ(features.shared[0], 0);
}

TEST(CellFeatures, RepeatedCellsAreNotListedWhateverTheirOrder) {
  Mesh mesh;
  mesh.vertex_count = 4;
  mesh.faces = {{0, 1, 2}, {2, 0, 1}, {0, 1, 3}, {0, 0, 1}, {0, 1, 1}};
  mesh.edges = {{0, 1}, {1, 0}, {1, 1}, {2, 1}};
  const CellFeatures features = find_owners(mesh, true);
  const auto listed = [&](std::size_t cell) { return (features.owned[cell] & cell_bit) != 0; };
  const std::vector<bool> expected = {true, false, true, true, true, true, false, true, true};
  for (std::size_t cell = 0; cell < expected.size(); ++cell) EXPECT_EQ(listed(cell), expected[cell]) << cell;
}

TEST(CellFeatures, CellsAreListedOnlyOnRequest) {
  Mesh mesh;
  mesh.vertex_count = 3;
  mesh.faces = {{0, 1, 2}};
  mesh.edges = {{0, 1}};
  for (const std::size_t cell : {0U, 1U}) {
    EXPECT_EQ(find_owners(mesh, false).owned[cell] & cell_bit, 0);
    EXPECT_EQ(find_owners(mesh, true).owned[cell] & cell_bit, cell_bit);
  }
}

TEST(CellFeatures, CellsYieldWhatOthersHave) {
  Mesh mesh;
  mesh.vertex_count = 5;
  mesh.faces = {{0, 1, 2}, {2, 1, 3}, {1, 2, 0}, {2, 2, 1}};
  mesh.points = {4};
  const auto owned = [&](const std::vector<bool>& yields) { return find_owners(mesh, false, yields).owned; };
  const std::vector<FeatureMask> by_number = {7 | 7 << 3, corner_bit(2) | edge_bit(1) | edge_bit(2), 0, edge_bit(0),
                                              corner_bit(0)};
  EXPECT_EQ(owned({}), by_number);
  EXPECT_EQ(owned({false, false, true, false, true}), by_number);
  EXPECT_EQ(owned({true, true, true, true, true}), by_number);
  EXPECT_EQ(
      owned({true, false, true, true, true}),
      (std::vector<FeatureMask>{corner_bit(0) | edge_bit(0) | edge_bit(2), 7 | 7 << 3, 0, edge_bit(0), corner_bit(0)}));
  EXPECT_EQ(
      owned({true, true, false, false, false}),
      (std::vector<FeatureMask>{0, corner_bit(2) | edge_bit(1) | edge_bit(2), 7 | 7 << 3, edge_bit(0), corner_bit(0)}));
  for (const bool first : {false, true}) {
    const auto shared = find_owners(mesh, false, {first, !first, false, true, false}).shared;
    EXPECT_EQ(shared, find_owners(mesh, false).shared);
  }
}

}  // namespace
}  // namespace noli
