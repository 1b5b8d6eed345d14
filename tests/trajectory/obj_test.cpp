// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/obj.h"

#include "support.h"
#include "trajectory/formats/frames.h"

namespace noli {
namespace {

TEST(ObjComment, IsNotContinuedByABackslashAtItsEnd) {
  const Frame frame = parse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n# C:\\x\\\nf 1 2 3\nf 3 2 1 # D:\\\nf 2 1 3\n", "a.obj");
  EXPECT_EQ(frame.mesh.faces.size(), 3U);
}

using testing::bits;
using Faces = decltype(Mesh::faces);
using Edges = decltype(Mesh::edges);

const std::string four = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";  // lines 1 to 4

TEST(Obj, EverythingThatIsAllowed) {
  const Frame frame = parse_obj(
      "# a comment\r\nmtllib a.mtl\r\no thing\r\nv 1 2 3\r\nv 1 2 0\r\nv 1 2 3 0.5\r\nv 1 2 3 .1 .2 .3\r\nv +1e-3 -0 3 "
      "1 "
      ".1 .2 .3\r\n"
      "vt 0 0\r\nvn 0 0 1\r\ng group\r\nusemtl m\r\ns off\r\n"
      "f 1 2 3 4 5\r\nf 1/1 2/1 3/7\r\nf 1//1 2//1 5//1\r\nf 1/1/1 2/1/1 -1/-1/-1 # the last\r\n"
      "l 6 7 8\r\np 9 9 10\r\nf \\\r\n 1 2 \\\r\n 3\r\n\r\nv 6 0 0\r\nv 7 0 0\r\nv 8 0 0\r\nv 9 0 0\r\nv 10 0 0",
      "all.obj");
  EXPECT_EQ(bits({frame.positions.begin(), frame.positions.begin() + 5}),
            bits({{1, 2, 3}, {1, 2, 0}, {1, 2, 3}, {1, 2, 3}, {1e-3, -0.0, 3}}));
  EXPECT_EQ(frame.mesh.vertex_count, 10u);
  EXPECT_EQ(frame.mesh.faces, (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 1, 2}, {0, 1, 4}, {0, 1, 4}, {0, 1, 2}}));
  EXPECT_EQ(frame.mesh.edges, (Edges{{5, 6}, {6, 7}}));
  EXPECT_EQ(frame.mesh.points, (std::vector<VertexId>{8, 9}));
}

TEST(Obj, InThePlaneVerticesHaveTwoCoordinates) {
  EXPECT_EQ(bits(parse_obj("v 1 2\nv 3 4\nl 1 2\n", "plane.obj").positions), bits({{1, 2, 0}, {3, 4, 0}}));
}

TEST(Obj, NegativeIndicesCountBackFromWhereTheyStand) {
  const Frame frame = parse_obj(four + "f -4 -3 -2\nv 5 5 5\nf -1 -2 -5\nl -1/-1 -2\n", "t");
  EXPECT_EQ(frame.mesh.faces, (Faces{{0, 1, 2}, {4, 3, 0}}));
  EXPECT_TRUE(frame.mesh.edges.empty()) << "4-3 is an edge of the second face";
}

TEST(Obj, DoesNotLookAtWhatFollowsASlash) {
  for (const std::string corner : {"3/", "3//", "3/x", "3/1/1/1", "-2//0"}) {
    const Frame frame = parse_obj(four + "f 1 2 " + corner + "\nl 1/1/1 4/\np 4/1\n", "t");
    EXPECT_EQ(frame.mesh.faces, (Faces{{0, 1, 2}})) << corner;
    EXPECT_EQ(frame.mesh.edges, (Edges{{0, 3}})) << corner;
  }
}

struct BadObj {
  const char* name;
  std::string text;
  std::string message;
  friend void PrintTo(const BadObj& bad, std::ostream* out) { *out << bad.name; }
};

const BadObj bad_objs[] = {
    {"empty", "", "is empty"},
    {"no_text", "\x01\n", "line 1: expected a statement of a mesh (v, f, l, p, ...), found '?'"},
    {"surface", four + "curv 0 1 1 2\n", "line 5: expected a statement of a mesh (v, f, l, p, ...), found 'curv'"},
    {"one_coordinate", "v 1\n",
     "line 1: a vertex has 2, 3 or 4 coordinates, and a colour of 3 numbers or none; found 1 numbers"},
    {"five_numbers", "v 1 2 3 4 5\n",
     "line 1: a vertex has 2, 3 or 4 coordinates, and a colour of 3 numbers or none; found 5 numbers"},
    {"eight_numbers", "v 1 2 3 4 5 6 7 8\n",
     "line 1: a vertex has 2, 3 or 4 coordinates, and a colour of 3 numbers or none; found 8 numbers"},
    {"z_is_missing", four + "v 1 2\n", "line 5: a vertex with 2 coordinates; the vertices before it have 3 or more"},
    {"z_in_a_plane", "v 1 2\nv 1 2 3\n", "line 2: a vertex with 3 or more coordinates; the vertices before it have 2"},
    {"no_number", "v 1 2 three\n", "line 1: expected a number, found 'three'"},
    {"nan", four + "v 1 nan 2\n", "line 5: expected a finite number, found 'nan'"},
    {"infinity", "v inf 1 2\n", "line 1: expected a finite number, found 'inf'"},
    {"nan_colour", "v 1 1 2 nan 0 0\n", "line 1: expected a finite number, found 'nan'"},
    {"overflow", "v 1 1 2e999\n", "line 1: '2e999' is outside the range of double"},
    {"two_corners", four + "f 1 2\n", "line 5: a face has at least 3 corners, found 2"},
    {"short_line", four + "l 1\n", "line 5: a line has at least 2 vertices, found 1"},
    {"no_point", four + "p\n", "line 5: expected at least one vertex after 'p'"},
    {"zero", four + "f 1 2 0\n", "line 5: index 0 in '0', expected indices from 1, or from -1 backwards"},
    {"beyond", four + "f 1 2 5\n\nf 1 2 3\n",
     "line 5: vertex index 5 is out of range, the file has 4 vertices, counted from 1"},
    {"far_beyond", four + "f 1 2 4294967296\n", "line 5: vertex index '4294967296' is out of range"},
    {"before", four + "f 1 2 -5\n", "line 5: '-5' points back beyond the first vertex, 4 are known here"},
    {"huge", four + "f 1 2 99999999999999999999\n", "line 5: expected an index, found '99999999999999999999'"},
    {"most_negative", four + "p -9223372036854775808\n",
     "line 5: '-9223372036854775808' points back beyond the first vertex, 4 are known here"},
    {"real_index", four + "f 1 2 3.0\n", "line 5: expected an index, found '3.0'"},
    {"empty_vertex", four + "f 1 2 /1\n", "line 5: expected an index, found '/1'"},
    {"joined_lines", four + "f \\\n1 2 \\\n x\nf 1 2 3\n", "line 5: expected an index, found 'x'"},
    {"joined_to_nothing", four + "f 1 2 \\", "line 5: a face has at least 3 corners, found 2"},
};

class ObjErrors : public ::testing::TestWithParam<BadObj> {};
INSTANTIATE_TEST_SUITE_P(All, ObjErrors, ::testing::ValuesIn(bad_objs), [](const auto& bad) { return bad.param.name; });

TEST_P(ObjErrors, SaysWhatAndWhere) {
  EXPECT_EQ(testing::input_error([] { parse_obj(GetParam().text, "bad.obj"); }), "bad.obj: " + GetParam().message);
}

TEST(ObjFiles, MissingAndEmpty) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(testing::input_error([&] { read_frame(folder / "none.obj"); }),
            (folder / "none.obj").string() + ": cannot be opened: No such file or directory");
  EXPECT_EQ(testing::input_error([&] { read_frame(folder.write("empty.obj", "")); }),
            (folder / "empty.obj").string() + ": is empty");
}

}  // namespace
}  // namespace noli
