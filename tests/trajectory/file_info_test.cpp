// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/file_info.h"

#include "support.h"
#include "trajectory/formats/polygons.h"

namespace noli {
namespace {

TEST(FileInfo, CountsEverything) {
  const test::TemporaryFolder folder;
  const FileInfo info =
      describe_file(folder.write("a.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv -5 7 0\nv 0 0 -0\nv 9 9 0\nv 3 3 0\n"
                                 "f 1 2 3\nf 1 2 4\nf 1 1 3\nf 1 6 3\nl 4 5\np 8\n"));
  EXPECT_EQ(info.format, "OBJ");
  EXPECT_EQ(info.number_type, "decimal");
  EXPECT_EQ(info.vertices, 8u);
  EXPECT_EQ(info.faces, 4u);
  EXPECT_EQ(info.mesh_edges, 9u) << "01 12 02 14 04, 00 of the third, 05 52 of the fourth, and the loose one";
  EXPECT_EQ(info.loose_edges, 1u);
  EXPECT_EQ(info.loose_points, 1u);
  EXPECT_EQ(info.unreferenced_vertices, 1u);
  EXPECT_EQ(info.degenerate_faces, 3u) << "on one line, a repeated corner, coincident corners";
  EXPECT_EQ(info.coincident_vertices, 1u);
  ASSERT_TRUE(info.box.has_value());
  EXPECT_EQ(info.box->lower, (Position{-5, 0, 0}));
  EXPECT_EQ(info.box->upper, (Position{9, 9, 0}));
  EXPECT_TRUE(info.planar);
}

TEST(FileInfo, NamesFormatAndNumberType) {
  const test::TemporaryFolder folder;
  const auto info = [&](const std::string& format, const std::string& properties, const std::string& body) {
    return describe_file(folder.write(
        "a.ply", "ply\nformat " + format + " 1.0\nelement vertex 1\n" + properties + "end_header\n" + body));
  };
  const FileInfo ascii = info("ascii", "property double x\nproperty double y\nproperty double z\n", "1 2 3\n");
  EXPECT_EQ(ascii.format, "PLY ASCII");
  EXPECT_EQ(ascii.number_type, "float64");
  const FileInfo little = info("binary_little_endian", "property float x\nproperty float y\n", std::string(8, '\0'));
  EXPECT_EQ(little.format, "PLY binary little-endian");
  EXPECT_EQ(little.number_type, "float32");
  const FileInfo big =
      info("binary_big_endian", "property int y\nproperty float z\nproperty int x\n", std::string(12, '\0'));
  EXPECT_EQ(big.format, "PLY binary big-endian");
  EXPECT_EQ(big.number_type, "int32/float32");
}

TEST(FileInfo, NoVertices) {
  const FileInfo info = describe_frame({});
  EXPECT_EQ(info.vertices, 0u);
  EXPECT_FALSE(info.box.has_value());
}

TEST(FileInfo, NotPlanar) {
  EXPECT_FALSE(describe_frame({.mesh = {.vertex_count = 2, .faces = {}, .edges = {}, .points = {}},
                               .positions = {{0, 0, 0}, {0, 0, 1}}})
                   .planar);
}

TEST(FileInfo, BadFilesAreErrors) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(describe_file(folder / "none.ply"), InputError);
  EXPECT_THROW(describe_file(folder.write("a.txt", "v 0 0 0\n")), InputError);
}

TEST(ZeroArea, ExactlyOnALineOrNot) {
  const Position a{0, 0, 0}, b{1, 1, 1};
  EXPECT_TRUE(has_zero_area(a, b, {3, 3, 3}));
  EXPECT_TRUE(has_zero_area(a, b, {-0x1p-1074, -0x1p-1074, -0x1p-1074}));
  EXPECT_TRUE(has_zero_area(a, a, b));
  EXPECT_FALSE(has_zero_area(a, b, {3, 3, 3 + 0x1p-51}));
  EXPECT_FALSE(has_zero_area(a, b, {0, 0x1p-1074, 0})) << "its cross product underflows only almost";
  EXPECT_FALSE(has_zero_area(a, {0x1p-1074, 0, 0}, {0, 0x1p-1074, 0})) << "its cross product underflows";
  EXPECT_FALSE(has_zero_area({-1e308, 0, 0}, {1e308, 0, 0}, {0, 1e308, 0})) << "its cross product overflows";
  EXPECT_TRUE(has_zero_area({-1e308, 0, 0}, {1e308, 0, 0}, {5e307, 0, 0}));
  EXPECT_TRUE(has_zero_area({0.1, 0.1, 0}, {0.2, 0.2, 0}, {0.7, 0.7, 0}));
  EXPECT_FALSE(has_zero_area({0.1, 0.3, 0}, {0.2, 0.6, 0}, {0.3, 0.9, 0})) << "only as decimals are they on a line";
}

}  // namespace
}  // namespace noli
