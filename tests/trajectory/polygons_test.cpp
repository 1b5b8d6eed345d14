// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/polygons.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "support.h"
#include "trajectory/formats/obj.h"
#include "trajectory/formats/ply.h"

namespace noli {
namespace {

using testing::input_error;

std::string obj(const std::vector<Position>& corners) {
  std::string text, face = "f";
  for (const Position& x : corners) text += fmt::format("v {} {} {}\n", x[0], x[1], x[2]);
  for (std::size_t i = 1; i <= corners.size(); ++i) face += fmt::format(" {}", i);
  return text + face + "\n";
}

/// The non-planarity of one polygon.
double non_planarity(const std::vector<Position>& corners, double at_least = 0) {
  Polygons polygons;
  const Frame frame = parse_obj(obj(corners), "a.obj", &polygons);
  EXPECT_EQ(polygons.fans.size(), 1u);
  return largest_non_planarity(frame.mesh, polygons.fans, frame.positions, at_least);
}

TEST(Polygons, AreNotedByBothReaders) {
  Polygons of_obj, of_ply;
  parse_obj("v 0 0\nv 1 0\nv 1 1\nv 0 1\nv 2 2\nf 1 2 3\nf 1 2 3 4\nl 1 5\nf 1 2 3 4 5\n", "a.obj", &of_obj);
  parse_ply(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nelement face 4\nproperty list "
      "uchar int vertex_indices\nend_header\n0 0\n1 0\n1 1\n0 1\n2 2\n3 0 1 2\n4 0 1 2 3\n2 0 4\n5 0 1 2 3 4\n",
      "a.ply", &of_ply);
  for (const Polygons& polygons : {of_obj, of_ply}) {
    ASSERT_EQ(polygons.fans.size(), 2u);
    EXPECT_EQ(polygons.fans[0].first, 1u);
    EXPECT_EQ(polygons.fans[0].count, 2u);
    EXPECT_EQ(polygons.fans[1].first, 3u);
    EXPECT_EQ(polygons.fans[1].count, 3u);
  }
}

TEST(Polygons, AreRefusedWhenAsked) {
  Polygons refuse{PolygonRule::refuse};
  parse_obj("v 0 0\nv 1 0\nv 0 1\nf 1 2 3\nl 1 2 3\n", "a.obj", &refuse);
  EXPECT_EQ(input_error([&] { parse_obj("v 0 0\nv 1 0\nv 1 1\nv 0 1\n\nf 1 2 3 4\n", "a.obj", &refuse); }),
            "a.obj: line 6: a face of 4 corners; expected triangles (--polygons refuse): cut it into triangles, in all "
            "frames alike, or pass --polygons fan");
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nelement face 1\nproperty list "
      "uchar int vertex_indices\nend_header\n";
  EXPECT_EQ(input_error([&] { parse_ply(header + "0 0\n1 0\n1 1\n0 1\n4 0 1 2 3\n", "a.ply", &refuse); }),
            "a.ply: line 13: " + refused_polygon(4));
}

TEST(Polygons, FlatOnesHaveNone) {
  EXPECT_EQ(non_planarity({{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}}), 0);
  // On x + y + z = 1, oblique to the axes, where floating point may not decide.
  EXPECT_EQ(non_planarity({{0.5, 0.25, 0.25}, {1, 0, 0}, {0.125, 0.75, 0.125}, {-7.25, 3, 5.25}}), 0);
  EXPECT_EQ(non_planarity({{1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}, {1e300, 0, 0}}), 0);
}

TEST(Polygons, TheLeastBendCounts) {
  const double up = std::nextafter(0.25, 1);
  const double bend = non_planarity({{0.5, 0.25, 0.25}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.25, up}});
  EXPECT_GT(bend, 0);
  EXPECT_LT(bend, 0x1p-53);
  EXPECT_EQ(non_planarity({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0x1p-1074}}), 0x1p-1074);
}

TEST(Polygons, TheDistanceIsRoundedUp) {
  EXPECT_EQ(non_planarity({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 3}}), 3);
  // The plane of the first three corners is x + y + z = 1; the fourth is 1/sqrt(3) from it.
  EXPECT_EQ(non_planarity({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}), 0.57735026918962584);  // the double above
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(non_planarity({{0, 0, -huge}, {1, 0, -huge}, {1, 1, -huge}, {0, 1, huge}}),
            std::numeric_limits<double>::infinity());
}

TEST(Polygons, AnotherFirstCornerHasAnotherDistance) {
  const Position a = {0, 0, 0}, b = {4, 0, 0}, c = {4, 4, 0}, d = {0, 1, 3};
  EXPECT_EQ(non_planarity({a, b, c, d}), 3);
  EXPECT_NE(non_planarity({b, c, d, a}), 3);
  EXPECT_GT(non_planarity({b, c, d, a}), 0);
}

TEST(Polygons, TrianglesWithoutAreaMakeNoPlane) {
  EXPECT_EQ(non_planarity({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), 0);
  // The first triangle is a segment; the plane is that of the second, and a fifth corner is 2 above it.
  EXPECT_EQ(non_planarity({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 2}}), 2);
}

TEST(Polygons, TheLargestOfAllIsKept) {
  EXPECT_EQ(non_planarity({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 3}}, 2.5), 3);
  EXPECT_EQ(non_planarity({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 3}}, 3.5), 3.5);
  EXPECT_EQ(non_planarity({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 3}}, std::nextafter(3, 0)), 3);
}

}  // namespace
}  // namespace noli
