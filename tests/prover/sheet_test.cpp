// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/sheet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace noli::testing {
namespace {

using Faces = std::vector<LocalFace>;
using Layout = std::vector<Point2>;

const Layout square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Sheet, ATriangleAndASquareAre) {
  EXPECT_TRUE(is_sheet(Faces{{0, 1, 2}}, Layout{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_TRUE(is_sheet(Faces{{0, 1, 2}, {0, 2, 3}}, square));
}

TEST(Sheet, StraightBordersMayHaveVertices) {
  const Layout layout = {{0, 0}, {1, 0}, {2, 0}, {0, 2}};
  EXPECT_TRUE(is_sheet(Faces{{0, 1, 3}, {1, 2, 3}}, layout));
}

TEST(Sheet, FacesMustBeCounterclockwise) {
  EXPECT_FALSE(is_sheet(Faces{{0, 2, 1}}, square));
  EXPECT_FALSE(is_sheet(Faces{{0, 1, 2}, {0, 3, 2}}, square));
  EXPECT_FALSE(is_sheet(Faces{{0, 1, 2}}, Layout{{0, 0}, {1, 1}, {2, 2}}));
  // A vertex is pulled over the opposite edge: the border stays, but one face flips.
  const Faces fan = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  Layout layout = square;
  layout.push_back({0.5, 0.5});
  EXPECT_TRUE(is_sheet(fan, layout));
  layout[4] = {0.5, -0.25};
  EXPECT_FALSE(is_sheet(fan, layout));
  layout[4] = {0.5, 0};
  EXPECT_FALSE(is_sheet(fan, layout));
}

TEST(Sheet, TheBorderMustBeConvex) {
  const Faces faces = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_FALSE(is_sheet(faces, Layout{{0, 0}, {2, 1}, {0.5, 0.5}, {1, 2}}));
  EXPECT_TRUE(is_sheet(faces, Layout{{0, 0}, {2, 1}, {2, 2}, {1, 2}}));
}

/// A fan of faces that winds around vertex 0 several times, on a border of `n` vertices.
struct Fan {
  Faces faces;
  Layout layout = {{0, 0}};
};

Fan fan(std::uint32_t n, int turns) {
  Fan result;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * turns * i / n;
    result.layout.push_back({std::cos(angle), std::sin(angle)});
    result.faces.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return result;
}

TEST(Sheet, ItMustGoAroundOnce) {
  EXPECT_TRUE(is_sheet(fan(9, 1).faces, fan(9, 1).layout));
  EXPECT_FALSE(is_sheet(fan(9, 2).faces, fan(9, 2).layout));  // every face positive, every turn to the left
  EXPECT_FALSE(is_sheet(fan(10, 3).faces, fan(10, 3).layout));
}

TEST(Sheet, TheBorderMustBeOneCycle) {
  Layout layout = {{0, 0}, {3, 0}, {0, 3}, {1, 0.5}, {1.5, 0.5}, {1, 1}};
  EXPECT_FALSE(is_sheet(Faces{{0, 1, 2}, {3, 4, 5}}, layout));
  EXPECT_TRUE(border_of(Faces{{0, 1, 2}, {3, 4, 5}}, 6).empty());
  EXPECT_TRUE(border_of(Faces{{0, 1, 2}, {0, 3, 4}}, 5).empty());  // joined at a vertex
  EXPECT_TRUE(border_of(Faces{{0, 1, 2}, {0, 2, 1}}, 3).empty());  // closed
  EXPECT_EQ(border_of(Faces{{0, 1, 2}, {0, 2, 3}}, 4), (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(Sheet, EdgesMustBeThereOnceInADirection) {
  EXPECT_TRUE(border_of(Faces{{0, 1, 2}, {0, 1, 3}}, 4).empty());
  EXPECT_TRUE(border_of(Faces{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5).empty());
  EXPECT_TRUE(border_of(Faces{{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, 5).empty());
  EXPECT_TRUE(border_of(Faces{{0, 1, 2}, {0, 1, 2}}, 3).empty());
  EXPECT_LT(border_of(Faces{{0, 0, 1}}, 2).size(), 3u);
}

TEST(Sheet, PlacesMustBeFinite) {
  EXPECT_FALSE(is_sheet(Faces{{0, 1, 2}}, Layout{{0, 0}, {1, 0}, {0, INFINITY}}));
  EXPECT_FALSE(is_sheet(Faces{{0, 1, 2}}, Layout{{0, 0}, {1, 0}, {NAN, 1}}));
}

/// Straight and nearly straight borders are distinguished.
TEST(Sheet, ConvexityIsExact) {
  const Faces faces = {{0, 1, 3}, {1, 2, 3}};
  for (const double low : {-0x1p-60, 0.0, 0x1p-60}) {
    EXPECT_EQ(is_sheet(faces, Layout{{0, 0}, {1, low}, {2, 0}, {0, 2}}), low <= 0);
  }
}

}  // namespace
}  // namespace noli::testing
