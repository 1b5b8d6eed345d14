// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernel/static_predicates.h"
#include "sheets.h"

namespace noli::testing {
namespace {

Sheets sheets_of(const Surface& surface, int dimension = 3, std::size_t least = 1) {
  return find_sheets(surface.mesh, surface.x, dimension, least);
}

/// The vertices of face b that are not in face a.
std::vector<VertexId> without(const std::array<VertexId, 3>& b, const std::array<VertexId, 3>& a) {
  std::vector<VertexId> rest;
  for (const VertexId v : b) {
    if (std::find(a.begin(), a.end(), v) == a.end()) rest.push_back(v);
  }
  return rest;
}

/// Whether face a and the part of face b without a's vertices are apart in the layout, exactly.
bool disjoint(const std::array<VertexId, 3>& a, const std::array<VertexId, 3>& b, const std::vector<Point2>& r) {
  const Triangle2 whole = {r[a[0]], r[a[1]], r[a[2]]};
  const auto rest = without(b, a);
  if (rest.size() == 1) return !intersects(r[rest[0]], whole);
  if (rest.size() == 2) return !intersects(Segment2{r[rest[0]], r[rest[1]]}, whole);
  return rest.empty() || !intersects(whole, Triangle2{r[b[0]], r[b[1]], r[b[2]]});
}

/// Tests the definition: two faces meet in the layout only in what they share.
bool injective(const Surface& surface, const Sheets& sheets) {
  for (const auto& faces : sheets.faces) {
    for (const auto i : faces) {
      for (const auto j : faces) {
        if (i != j && !disjoint(surface.mesh.faces[i], surface.mesh.faces[j], sheets.layout)) return false;
      }
    }
  }
  return true;
}

void expect_one_sheet(const Surface& surface, int dimension = 3) {
  const Sheets sheets = sheets_of(surface, dimension);
  ASSERT_EQ(sheets.faces.size(), 1u);
  EXPECT_EQ(sheets.faces[0].size(), surface.mesh.faces.size());
  EXPECT_TRUE(injective(surface, sheets));
}

TEST(Layout, AGridIsASheet) {
  expect_one_sheet(grid(8, 5));
  expect_one_sheet(grid(8, 5), 2);
  expect_one_sheet(grid(1, 40));
}

TEST(Layout, HoweverItIsTurnedAndScaled) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    Surface surface = grid(5, 7);
    turn(surface, random.unit(), random.unit(), random.unit());
    for (Position& x : surface.x) {
      for (double& c : x) c = c * 1e-5 + 1e3;
    }
    expect_one_sheet(surface);
  }
}

TEST(Layout, ACurvedSheetThatLiesInOneLayerIsASheet) {
  Surface surface = grid(12, 12);
  for (Position& x : surface.x) x[2] = 0.1 * (x[0] - 6) * (x[0] - 6) - 0.05 * x[1] * x[1];
  expect_one_sheet(surface);
}

TEST(Layout, RoughBordersAreStraightened) {
  Random random(2);
  Surface surface = grid(9, 9);
  for (Position& x : surface.x) {
    for (double& c : x) c += 0.15 * random.unit();
  }
  expect_one_sheet(surface);
}

TEST(Layout, OrientationsMayBeMixed) {
  Surface surface = grid(6, 6);
  for (std::size_t f = 0; f < surface.mesh.faces.size(); f += 3)
    std::swap(surface.mesh.faces[f][0], surface.mesh.faces[f][1]);
  expect_one_sheet(surface);
}

TEST(Layout, EachPartIsASheetOfItsOwn) {
  Surface surface = grid(4, 4);
  append(surface, grid(3, 3), {1, 1, 2});
  append(surface, grid(1, 1), {9, 9, 9});
  const Sheets all = sheets_of(surface);
  ASSERT_EQ(all.faces.size(), 3u);
  EXPECT_EQ(all.faces[1].front(), 32u);
  EXPECT_TRUE(injective(surface, all));
  EXPECT_EQ(sheets_of(surface, 3, 18).faces.size(), 2u);
  EXPECT_EQ(sheets_of(surface, 3, 19).faces.size(), 1u);
}

TEST(Layout, WhatIsNoSheet) {
  EXPECT_TRUE(sheets_of(closed_box(3)).faces.empty());
  EXPECT_TRUE(sheets_of(ring_of_squares(12)).faces.empty());  // a hole
  Surface folded = grid(8, 4);
  for (Position& x : folded.x) {
    if (x[0] > 4) x = {8 - x[0], x[1], 0.5};
  }
  EXPECT_TRUE(sheets_of(folded).faces.empty());

  Surface twice = grid(4, 4);
  twice.mesh.faces.push_back(twice.mesh.faces[3]);
  EXPECT_TRUE(sheets_of(twice).faces.empty());
  Surface thrice = grid(4, 4);
  thrice.x.push_back({2, 2, 3});
  thrice.mesh.faces.push_back({thrice.mesh.faces[3][0], thrice.mesh.faces[3][1], 25});
  thrice.mesh.vertex_count = 26;
  EXPECT_TRUE(sheets_of(thrice).faces.empty());  // three faces at one edge
  Surface needle = grid(4, 4);
  needle.mesh.faces[5][1] = needle.mesh.faces[5][0];
  EXPECT_TRUE(sheets_of(needle).faces.empty());
  Surface point = grid(4, 4);
  for (Position& x : point.x) x = {1, 1, 1};
  EXPECT_TRUE(sheets_of(point).faces.empty());
}

TEST(Layout, TwoPartsJoinedAtAVertexAreNoSheet) {
  Surface surface = grid(3, 3);
  append(surface, grid(3, 3), {3, 3, 0});
  for (auto& face : surface.mesh.faces) {
    for (VertexId& v : face) v = v == 16 ? 15 : v;  // both corners at (3, 3)
  }
  EXPECT_TRUE(sheets_of(surface).faces.empty());
}

/// Two vertices at one position form a slit whose sides touch.
TEST(Layout, ASlitSheetIsNone) {
  Surface surface = grid(6, 6);
  const VertexId middle = 3 * 7 + 3;
  surface.x.push_back(surface.x[middle]);
  surface.mesh.vertex_count = 50;
  for (auto& face : surface.mesh.faces) {
    for (VertexId& v : face) {
      const double y = (surface.x[face[0]][1] + surface.x[face[1]][1] + surface.x[face[2]][1]) / 3;
      if (v == middle && y > 3) v = 49;
    }
  }
  EXPECT_TRUE(sheets_of(surface).faces.empty());
}

/// Everything reported as a sheet is one.
TEST(Layout, OfRandomSurfacesIsInjectiveOrNone) {
  Random random(4);
  int sheets = 0, none = 0;
  for (int i = 0; i < 300; ++i) {
    Surface surface = grid(4, 4);
    const double rough = 0.5 * (1 + random.unit());
    for (Position& x : surface.x) {
      for (double& c : x) c += rough * random.unit();
    }
    if (random.below(3) == 0) surface.mesh.faces.erase(surface.mesh.faces.begin() + random.below(32));
    const Sheets found = sheets_of(surface);
    EXPECT_TRUE(injective(surface, found));
    (found.faces.empty() ? none : sheets) += 1;
  }
  EXPECT_GT(sheets, 30);
  EXPECT_GT(none, 30);
}

}  // namespace
}  // namespace noli::testing
