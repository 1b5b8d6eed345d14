// SPDX-License-Identifier: Apache-2.0
//
// Tests the readers on files made by others; visibly skipped where the files are missing.
#include "tests/support/real_data.h"
#include "support.h"
#include "trajectory/formats/file_info.h"
#include "trajectory/formats/frame_inputs.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/query_csv.h"

namespace noli {
namespace {

struct RealFrame {
  const char* name;
  const char* path;
  const char* format;
  const char* number_type;
  std::size_t vertices, edges, faces;
  friend void PrintTo(const RealFrame& real, std::ostream* out) { *out << real.name; }
};
const RealFrame real_frames[] = {
    {"cloth_funnel", "frames/cloth-funnel/227.ply", "PLY binary little-endian", "float64", 9450, 27930, 18484},
    {"armadillo_rollers", "frames/armadillo-rollers/326.ply", "PLY binary little-endian", "float64", 12135, 36363,
     24242},
    {"cloth_ball", "frames/cloth-ball/cloth_ball92.ply", "PLY binary big-endian", "float32", 46598, 138825, 92230},
    {"rod_twist_clean", "frames/rod-twist-clean/0.ply", "PLY binary little-endian", "float64", 39940, 119796, 79864},
};

class RealFrames : public ::testing::TestWithParam<RealFrame> {};
INSTANTIATE_TEST_SUITE_P(All, RealFrames, ::testing::ValuesIn(real_frames),
                         [](const auto& real) { return real.param.name; });

TEST_P(RealFrames, HaveTheKnownCounts) {
  const auto path = test::real_data(GetParam().path);
  if (!path) GTEST_SKIP() << "no real data";
  const FileInfo info = describe_file(*path);
  EXPECT_EQ(info.format, GetParam().format);
  EXPECT_EQ(info.number_type, GetParam().number_type);
  EXPECT_EQ(info.vertices, GetParam().vertices);
  EXPECT_EQ(info.mesh_edges, GetParam().edges);
  EXPECT_EQ(info.faces, GetParam().faces);
  EXPECT_EQ(info.loose_edges + info.loose_points, 0u);
  EXPECT_FALSE(info.planar);
}

TEST(RealSequences, SuccessiveFramesHaveOneMesh) {
  const auto folder = test::real_data("frames/cloth-ball");
  if (!folder) GTEST_SKIP() << "no real data";
  FrameInputs frames({*folder / "cloth_ball92.ply", *folder / "cloth_ball93.ply"});
  FrameSequence sequence(frames);
  ASSERT_TRUE(sequence.next());
  EXPECT_EQ(sequence.x_t0().size(), 46598u);
  EXPECT_EQ(sequence.x_t1().size(), 46598u);
  EXPECT_FALSE(sequence.next());
}

struct RealQueries {
  const char* name;
  const char* file;
  std::size_t queries, positive;
  friend void PrintTo(const RealQueries& real, std::ostream* out) { *out << real.name; }
};
const RealQueries real_queries[] = {
    {"armadillo_rollers_vertex_face", "armadillo-rollers-vertex-face.csv", 4652, 4650},
    {"cloth_funnel_edge_edge", "cloth-funnel-edge-edge.csv", 263, 107},
    {"cloth_funnel_vertex_face", "cloth-funnel-vertex-face.csv", 92, 27},
    {"unit_tests_edge_edge_0", "unit-tests-edge-edge-0.csv", 54, 21},
    {"erleben_spikes_vertex_face_0", "erleben-spikes-vertex-face-0.csv", 125, 11},
};

class RealQueryFiles : public ::testing::TestWithParam<RealQueries> {};
INSTANTIATE_TEST_SUITE_P(All, RealQueryFiles, ::testing::ValuesIn(real_queries),
                         [](const auto& real) { return real.param.name; });

TEST_P(RealQueryFiles, AreLabelledAndExact) {
  const auto path = test::real_data(std::string("queries/") + GetParam().file);
  if (!path) GTEST_SKIP() << "no real data";
  const auto kind = kind_from_file_name(*path);
  ASSERT_TRUE(kind.has_value());
  const auto queries = read_query_csv(*path, *kind);
  EXPECT_EQ(queries.size(), GetParam().queries);
  std::size_t positive = 0;
  for (const QueryRecord& query : queries) positive += query.label.value_or(false);
  EXPECT_EQ(positive, GetParam().positive);
}

}  // namespace
}  // namespace noli
