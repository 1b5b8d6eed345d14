// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frames.h"

#include <cmath>

#include "support.h"
#include "trajectory/formats/frame_inputs.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/write_ply.h"

namespace noli {
namespace {

using test::TemporaryFolder;
using testing::input_error;

const std::string face_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A frame of a rising triangle, at height z.
Frame rising(double z) {
  return {.mesh = {.vertex_count = 3, .faces = {{0, 1, 2}}, .edges = {}, .points = {}},
          .positions = {{0, 0, z}, {1, 0, z}, {0, 1, z}}};
}

std::vector<std::filesystem::path> write_rising(const TemporaryFolder& folder, int count) {
  std::vector<std::filesystem::path> paths;
  for (int k = 0; k < count; ++k) {
    paths.push_back(folder / (std::to_string(k) + ".ply"));
    write_ply(paths.back(), rising(k), PlyEncoding::binary_little_endian);
  }
  return paths;
}

TEST(Frames, ExtensionDecides) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_frame(folder.write("a.OBJ", face_obj)).mesh.faces.size(), 1u);
  const std::string ply = format_ply(rising(0), PlyEncoding::ascii);
  EXPECT_EQ(read_frame(folder.write("a.Ply", ply)).mesh.faces.size(), 1u);
  EXPECT_EQ(input_error([&] { read_frame(folder.write("a.stl", ply)); }),
            (folder / "a.stl").string() + ": expected a file that ends in .ply, .obj, .vtu or .vtp, found '.stl'; " +
                conversion_advice("a.stl"));
  EXPECT_EQ(input_error([&] { read_frame(folder.write("a", ply)); }),
            (folder / "a").string() + ": expected a file that ends in .ply, .obj, .vtu or .vtp, found ''");
}

TEST(Frames, LinearStepsJoinSuccessiveFrames) {
  const TemporaryFolder folder;
  FrameInputs frames(write_rising(folder, 4));
  FrameSequence sequence(frames);
  EXPECT_EQ(frames.count(), 4u);
  EXPECT_EQ(sequence.step_count(), 3u);
  for (std::size_t step = 0; step < 3; ++step) {
    ASSERT_TRUE(sequence.next());
    EXPECT_EQ(sequence.step(), step);
    EXPECT_EQ(sequence.x_t0()[2], (Position{0, 1, static_cast<double>(step)}));
    EXPECT_EQ(sequence.x_t1()[2], (Position{0, 1, static_cast<double>(step + 1)}));
    EXPECT_EQ(sequence.name_t0(), (folder / (std::to_string(step) + ".ply")).string());
    EXPECT_EQ(sequence.name_t1(), (folder / (std::to_string(step + 1) + ".ply")).string());
    EXPECT_EQ(sequence.mesh().faces.size(), 1u);
  }
  EXPECT_FALSE(sequence.next());
}

TEST(Frames, ConstantStepsStandStill) {
  const TemporaryFolder folder;
  FrameInputs frames(write_rising(folder, 2));
  FrameSequence sequence(frames, Motion::constant);
  EXPECT_EQ(sequence.step_count(), 2u);
  for (std::size_t step = 0; step < 2; ++step) {
    ASSERT_TRUE(sequence.next());
    EXPECT_EQ(sequence.step(), step);
    EXPECT_EQ(sequence.x_t0().data(), sequence.x_t1().data());
    EXPECT_EQ(sequence.x_t0()[0][2], static_cast<double>(step));
    EXPECT_EQ(sequence.name_t0(), sequence.name_t1());
  }
  EXPECT_FALSE(sequence.next());
}

TEST(Frames, TooFewFrames) {
  FrameInputs none({}), one({"one.ply"});
  EXPECT_EQ(input_error([&] { FrameSequence{none}; }), "frames: there are none");
  EXPECT_EQ(input_error([&] { FrameSequence(none, Motion::constant); }), "frames: there are none");
  EXPECT_EQ(input_error([&] { FrameSequence{one}; }),
            "one.ply: is a single frame, expected at least two to have a motion");
  EXPECT_EQ(FrameSequence(one, Motion::constant).step_count(), 1u);
}

TEST(Frames, ReadsNothingBeforeItIsAsked) {
  FrameInputs frames({"missing-a.ply", "missing-b.ply"});
  FrameSequence sequence(frames);
  EXPECT_EQ(input_error([&] { sequence.next(); }), "missing-a.ply: cannot be opened: No such file or directory");
}

struct OtherMesh {
  const char* name;
  std::string text;
  std::string difference;  ///< NAME stands for the first file
  friend void PrintTo(const OtherMesh& bad, std::ostream* out) { *out << bad.name; }
};
const std::string cells_obj = "v 0 0\nv 1 0\nv 0 1\nv 3 3\nv 4 4\nv 5 5\nf 1 2 3\nl 4 5\np 6\n";
const std::string vertices = cells_obj.substr(0, cells_obj.find('f'));
const OtherMesh other_meshes[] = {
    {"vertices", cells_obj + "v 1 1\n", "has 7 vertices, but NAME has 6"},
    {"face_count", cells_obj + "f 2 1 3\n", "has 2 faces, but NAME has 1"},
    {"edge_count", cells_obj + "l 4 6\n", "has 2 loose edges, but NAME has 1"},
    {"point_count", vertices + "f 1 2 3\nl 4 5\n", "has 0 loose points, but NAME has 1"},
    {"face", vertices + "f 2 3 1\nl 4 5\np 6\n", "face 0 has vertices [1, 2, 0], but NAME has [0, 1, 2] there"},
    {"edge", vertices + "f 1 2 3\nl 5 4\np 6\n", "loose edge 0 has vertices [4, 3], but NAME has [3, 4] there"},
    {"point", vertices + "f 1 2 3\nl 4 6\np 5\n", "loose edge 0 has vertices [3, 5], but NAME has [3, 4] there"},
};

class DifferentMeshes : public ::testing::TestWithParam<OtherMesh> {};
INSTANTIATE_TEST_SUITE_P(All, DifferentMeshes, ::testing::ValuesIn(other_meshes),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(DifferentMeshes, AreNamedWithTheFirstDifference) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", cells_obj), b = folder.write("b.obj", GetParam().text);
  std::string expected =
      b.string() + ": " + GetParam().difference + "; all frames must have the same mesh; --body is for several bodies";
  expected.replace(expected.find("NAME"), 4, a.string());
  FrameInputs frames({a, a, b});
  FrameSequence sequence(frames);
  ASSERT_TRUE(sequence.next());
  EXPECT_EQ(input_error([&] { sequence.next(); }), expected);
}

TEST(Frames, PlanarOrNot) {
  EXPECT_TRUE(all_z_equal({}));
  EXPECT_TRUE(all_z_equal(std::vector<Position>{{1, 2, 5}, {3, 4, 5}}));
  EXPECT_TRUE(all_z_equal(std::vector<Position>{{1, 2, 0.0}, {3, 4, -0.0}}));
  EXPECT_FALSE(all_z_equal(std::vector<Position>{{1, 2, 5}, {3, 4, 5}, {3, 4, std::nextafter(5.0, 6.0)}}));
}

}  // namespace
}  // namespace noli
