// SPDX-License-Identifier: Apache-2.0
#include "trajectory/merge.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "support.h"
#include "trajectory/formats/frame_inputs.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/write_ply.h"

namespace noli {
namespace {

using Positions = std::vector<Position>;
using Ids = std::vector<VertexId>;

TEST(Merge, EqualAtAllTimesOrNotAtAll) {
  IdenticalVertices classes(5);
  classes.refine(Positions{{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}});
  EXPECT_EQ(classes.representative(), (Ids{0, 1, 0, 1, 0}));
  EXPECT_EQ(classes.merged_count(), 3u);
  classes.refine(Positions{{2, 0, 0}, {2, 0, 0}, {3, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  EXPECT_EQ(classes.representative(), (Ids{0, 1, 2, 1, 2})) << "0 and 1 meet now but were apart before";
  EXPECT_EQ(classes.merged_count(), 2u);
}

TEST(Merge, ZeroesOfEitherSignAreEqualAndAnUlpIsNot) {
  IdenticalVertices classes(4);
  classes.refine(Positions{{0.0, -0.0, 1}, {-0.0, 0.0, 1}, {0x1p-1074, 0, 1}, {0, 0, 1 + 0x1p-52}});
  EXPECT_EQ(classes.representative(), (Ids{0, 0, 2, 3}));
}

TEST(Merge, NothingToMerge) {
  IdenticalVertices none(0);
  none.refine(Positions{});
  EXPECT_EQ(none.merged_count(), 0u);
  IdenticalVertices all_different(2);
  all_different.refine(Positions{{0, 0, 0}, {0, 0, 1}});
  EXPECT_EQ(all_different.merged_count(), 0u);
}

/// By definition, in quadratic time: the least vertex with the same position in every frame.
Ids brute_force(const std::vector<Positions>& frames, std::size_t count) {
  Ids result(count);
  for (VertexId v = 0; v < count; ++v) {
    VertexId u = 0;
    while (!std::all_of(frames.begin(), frames.end(), [&](const Positions& x) { return x[u] == x[v]; })) ++u;
    result[v] = u;
  }
  return result;
}

RC_GTEST_PROP(Merge, AgreesWithTheDefinition, ()) {
  const std::size_t count = *rc::gen::inRange<std::size_t>(1, 30);
  const auto coordinate = rc::gen::element(0.0, -0.0, 1.0);
  const auto position = rc::gen::container<Position>(coordinate);
  const auto frames = *rc::gen::container<std::vector<Positions>>(*rc::gen::inRange<std::size_t>(1, 4),
                                                                  rc::gen::container<Positions>(count, position));
  IdenticalVertices classes(count);
  for (const Positions& frame : frames) classes.refine(frame);
  RC_ASSERT(classes.representative() == brute_force(frames, count));
}

TEST(Merge, MeshRefersToTheFirstOfEachClass) {
  IdenticalVertices classes(6);
  classes.refine(Positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}, {1, 0, 0}, {5, 5, 5}});
  const Mesh mesh{
      .vertex_count = 6, .faces = {{3, 4, 2}, {0, 3, 5}}, .edges = {{3, 1}, {1, 4}, {4, 5}}, .points = {4, 3}};
  const Mesh merged = with_merged_vertices(mesh, classes);
  EXPECT_EQ(merged.vertex_count, 6u);
  EXPECT_EQ(merged.faces, (decltype(Mesh::faces){{0, 1, 2}, {0, 0, 5}})) << "the second became degenerate and stays";
  EXPECT_EQ(merged.edges, (decltype(Mesh::edges){{1, 1}, {1, 5}})) << "0-1 became an edge of a face";
  EXPECT_TRUE(merged.points.empty());
}

/// Does the same as `noli verify --merge-identical`.
IdenticalVertices find_identical_vertices(const std::vector<std::filesystem::path>& paths) {
  FrameInputs frames(paths);
  FrameSequence sequence(frames, Motion::constant);
  sequence.next();
  IdenticalVertices classes(sequence.mesh().vertex_count);
  do {
    classes.refine(sequence.x_t0());
  } while (sequence.next());
  return classes;
}

TEST(Merge, ReadsAllFrames) {
  const test::TemporaryFolder folder;
  const auto write = [&](const std::string& name, const Positions& x) {
    write_ply(folder / name,
              {.mesh = {.vertex_count = x.size(), .faces = {}, .edges = {}, .points = {}}, .positions = x},
              PlyEncoding::ascii);
    return folder / name;
  };
  const auto a = write("a.ply", {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}),
             b = write("b.ply", {{1, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(find_identical_vertices({a}).representative(), (Ids{0, 0, 0}));
  EXPECT_EQ(find_identical_vertices({a, b}).representative(), (Ids{0, 0, 2}));
  EXPECT_EQ(find_identical_vertices({a, b}).merged_count(), 1u);
  const auto c = write("c.ply", {{0, 0, 0}});
  EXPECT_THROW(find_identical_vertices({a, c}), InputError);
}

}  // namespace
}  // namespace noli
