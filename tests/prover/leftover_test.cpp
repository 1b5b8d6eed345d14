// SPDX-License-Identifier: Apache-2.0
//
// Tests pairs of features that no larger pair of the same two cells covers.
#include "proofs/prover/cells/leftover.h"

#include <gtest/gtest.h>

#include "scenes.h"
#include "window_scenes.h"

namespace noli::testing {
namespace {

using Counts = std::array<std::uint64_t, 4>;

/// Expects the same counts for frames and for a window. `initial`: the number of pairs of cells that meet at the
/// beginning.
void expect_counts(const Step& step, const Counts& counts, std::uint64_t initial, bool strict = false,
                   int dimension = 3) {
  VerifyOptions options;
  options.strict = strict;
  options.dimension = dimension;
  const VerifyResult frames = verify_step(step.mesh, step.x_t0, step.x_t1, options);
  EXPECT_EQ(frames.contacts, counts);
  EXPECT_EQ(frames.initial_intersections, initial);
  WindowOptions window_options;
  window_options.strict = strict;
  window_options.dimension = dimension;
  const auto window = verify_window(step.mesh, WorldLines::from_frames(step.x_t0, step.x_t1), window_options);
  EXPECT_EQ(window.contacts, counts);
  EXPECT_EQ(window.initial_intersections, initial);
}

/// Edges ab and ac; c passes through ab (height 0) in the middle of the step, or stops above it.
Step bent_rod(double height_at_t1) {
  Step step;
  const VertexId a = step.vertex({0, 0, 0}), b = step.vertex({4, 0, 0});
  const VertexId c = step.vertex({1, 1, 0}, {1, height_at_t1, 0});
  step.mesh.edges = {{a, b}, {a, c}};
  return step;
}

TEST(Leftover, AnEndOfALooseEdgeMeetsTheNextLooseEdge) {
  const Step meets = bent_rod(-1);
  expect_counts(meets, {0, 0, 1, 0}, 0);
  const VerifyResult result = verify_step(meets.mesh, meets.x_t0, meets.x_t1, {});
  ASSERT_TRUE(result.first);
  EXPECT_EQ(result.first->vertices, (std::array<VertexId, 4>{2, 0, 1, 0}));
  EXPECT_EQ(result.first->first.begin, 0.5);
  expect_counts(meets, {0, 0, 1, 0}, 0, false, 2);
  expect_counts(bent_rod(0.5), {0, 0, 0, 0}, 0);
  expect_counts(bent_rod(0), {0, 0, 1, 0}, 0);
}

TEST(Leftover, AtTheBeginningItIsAnIntersectionToo) {
  Step step = bent_rod(0);
  step.x_t0 = step.x_t1;  // like --static
  expect_counts(step, {0, 0, 1, 0}, 1);
  step = bent_rod(1);
  expect_counts(step, {0, 0, 0, 0}, 0);
}

TEST(Leftover, CountsOncePerPairOfFeatures) {
  Step step = bent_rod(-1);
  step.mesh.edges = {{0, 1}, {2, 0}, {1, 0}, {0, 2}};
  expect_counts(step, {0, 0, 1, 0}, 0);
  step.mesh.edges = {{0, 1}, {0, 2}, {1, 2}};  // both ca, ab and cb, ab leave c against ab over
  expect_counts(step, {0, 0, 1, 0}, 0);
  step.mesh.points = {2, 2};
  expect_counts(step, {0, 0, 1, 0}, 0);
  expect_counts(step, {0, 0, 1, 0}, 0, true);
}

TEST(Leftover, WhereARodGoesOnTheNextEdgeMeetsToo) {
  Step step = bent_rod(-1);
  const VertexId d = step.vertex({1, 2, 0});
  step.mesh.edges.push_back({2, d});
  expect_counts(step, {0, 1, 1, 0}, 0);
}

TEST(Leftover, ALooseEdgeOfAFaceMakesTwoCells) {
  Step step = bent_rod(-1);
  step.mesh.edges.clear();
  step.mesh.faces = {{0, 1, 2}};
  expect_counts(step, {0, 0, 0, 0}, 0);
  step.mesh.edges = {{0, 1}};
  expect_counts(step, {0, 0, 1, 0}, 0);
  step.mesh.edges = {{0, 2}};
  expect_counts(step, {0, 0, 1, 0}, 0);
  step.mesh.edges.clear();
  step.mesh.points = {2};
  expect_counts(step, {0, 0, 1, 0}, 0);
  step.mesh.points.clear();
  step.mesh.faces = {{0, 1, 2}, {0, 1, 2}};
  expect_counts(step, {0, 0, 1, 0}, 0);
  step.x_t1[2] = {1, 0.5, 0};
  expect_counts(step, {0, 0, 0, 0}, 0);
}

TEST(Leftover, TheEndsOfALooseEdgeWithALoosePointOnOne) {
  for (const int dimension : {2, 3}) {
    Step step;
    step.mesh.edges = {{step.vertex({0, 0, 0}), step.vertex({1, 0, 0}, {-1, 0, 0})}};
    expect_counts(step, {0, 0, 0, 0}, 0, false, dimension);
    step.mesh.points = {1};
    expect_counts(step, {0, 0, 0, 1}, 0, false, dimension);
    expect_counts(step, {0, 0, 0, 1}, 0, true, dimension);
    step.x_t1[1] = {0.5, 0, 0};
    expect_counts(step, {0, 0, 0, 0}, 0, false, dimension);
  }
}

Leftovers leftovers_of(const std::vector<CellShape>& shapes) {
  return {shapes.size(), [shapes](std::size_t i) {
            return Leftovers::NumberedShape{shapes[i], static_cast<std::uint32_t>(i)};
          }};
}

TEST(Leftover, TwoCellsAreNamedOrNone) {
  const CellShape ab{{0, 1, 1}, 2}, ac{{0, 2, 2}, 2}, cd{{2, 3, 3}, 2}, b{{1, 1, 1}, 1}, c{{2, 2, 2}, 1};
  const SmallPair c_ab = vertex_edge_pair(2, {1, 0}), b_c = vertex_vertex_pair(2, 1);
  using CellPair = Leftovers::CellPair;
  EXPECT_EQ(leftovers_of({ab, ac}).place_of(c_ab), CellPair(0, 1));
  EXPECT_EQ(leftovers_of({ab, cd}).place_of(c_ab), std::nullopt);
  EXPECT_EQ(leftovers_of({ab, cd, c, ac}).place_of(c_ab), CellPair(0, 2));
  EXPECT_TRUE(leftovers_of({ab, ac}).counted_at(c_ab, 1, 0));
  EXPECT_FALSE(leftovers_of({ab, ac, ac}).counted_at(c_ab, 2, 0));
  EXPECT_EQ(leftovers_of({ac, c, b}).place_of(b_c), CellPair(1, 2));
  EXPECT_EQ(leftovers_of({ab, ac, b}).place_of(b_c), std::nullopt);
}

}  // namespace
}  // namespace noli::testing
