// SPDX-License-Identifier: Apache-2.0
//
// Tests small scenes made by hand, each with the answer that follows from the definitions.
#include "proofs/prover/verifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "scenes.h"
#include "window_scenes.h"

namespace noli::testing {
namespace {

constexpr auto vertex_face = static_cast<std::size_t>(FeaturePair::vertex_face);
constexpr auto edge_edge = static_cast<std::size_t>(FeaturePair::edge_edge);
constexpr auto vertex_edge = static_cast<std::size_t>(FeaturePair::vertex_edge);
constexpr auto vertex_vertex = static_cast<std::size_t>(FeaturePair::vertex_vertex);

VerifyResult verify(const Step& step, const VerifyOptions& options = {}) {
  return verify_step(step.mesh, step.x_t0, step.x_t1, options);
}

VerifyOptions in_2d() {
  VerifyOptions options;
  options.dimension = 2;
  return options;
}

VerifyOptions strictly() {
  VerifyOptions options;
  options.strict = true;
  return options;
}

TEST(Verifier, NothingToVerifyIsComplete) {
  const VerifyResult result = verify({});
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.contact_count(), 0u);
  EXPECT_FALSE(result.first);
}

TEST(Verifier, OneFaceTouchesNothing) {
  Step step;
  step.face({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5});
  const VerifyResult result = verify(step);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.contact_count() + result.initial_intersections, 0u);
}

TEST(Verifier, FacesThatPassEachOtherMeet) {
  Step step;
  step.face({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  step.face({1, 1, 2}, {1, 1, 4}, {1, 2, 4}, {0, 0, -3});  // the corner (1, 1) goes through at t = 2/3
  const VerifyResult result = verify(step);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.contacts[vertex_face], 1u);
  EXPECT_EQ(result.contacts[edge_edge], 0u);
  EXPECT_EQ(result.initial_intersections, 0u);
  ASSERT_EQ(result.reports.size(), 1u);
  EXPECT_EQ(result.reports[0].vertices, (std::array<VertexId, 4>{3, 0, 1, 2}));
  ASSERT_TRUE(result.first);
  EXPECT_EQ(*result.first, result.reports[0]);
  EXPECT_LE(result.first->first.begin, 2.0 / 3);
  EXPECT_GE(result.first->first.end, 2.0 / 3);
}

TEST(Verifier, FacesThatStopShortDoNotMeet) {
  Step step;
  step.face({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  step.face({1, 1, 2}, {1, 1, 4}, {1, 2, 4}, {0, 0, -2 + 0x1p-50});
  EXPECT_EQ(verify(step).contact_count(), 0u);
}

TEST(Verifier, AnEdgeThatPiercesAFaceThroughoutIsAnIntersectionWithoutEvent) {
  Step step;
  step.face({0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {1, 0, 0});
  step.face({2, 2, -4}, {2, 2, 4}, {2, 3, 4}, {1, 0, 0});
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contact_count(), 0u);
  EXPECT_EQ(result.initial_intersections, 1u);
  ASSERT_EQ(result.initial_reports.size(), 1u);
  EXPECT_EQ(result.initial_reports[0], (InitialIntersection{0, 1}));
  EXPECT_FALSE(result.first);
}

TEST(Verifier, InitialIntersectionsAreNotLookedForWhenNotWanted) {
  Step step;
  step.face({0, 0, 0}, {8, 0, 0}, {0, 8, 0});
  step.face({2, 2, -4}, {2, 2, 4}, {2, 3, 4});
  VerifyOptions options;
  options.initial = false;
  EXPECT_EQ(verify(step, options).initial_intersections, 0u);
  EXPECT_EQ(verify(step).initial_intersections, 1u);
}

TEST(Verifier, AGrazeAtExactlyTheEndCounts) {
  Step step;
  step.face({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  step.face({1, 1, 1}, {1, 1, 2}, {1, 2, 2}, {0, 0, -1});
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contacts[vertex_face], 1u);
  EXPECT_EQ(result.initial_intersections, 0u);
  ASSERT_TRUE(result.first);
  EXPECT_EQ(result.first->first.end, 1);
  EXPECT_EQ(result.first->first.begin, 1);
}

TEST(Verifier, EdgesThatGrazeAtExactlyTheEndCount) {
  Step step;
  step.face({-1, 0, 0}, {1, 0, 0}, {0, 0, -3});
  step.face({0, -1, 1}, {0, 1, 1}, {0, 0, 3}, {0, 0, -1});
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contacts[edge_edge], 1u);
  EXPECT_EQ(result.contacts[vertex_face], 0u);
}

TEST(Verifier, ATouchAtTheBeginningIsBothContactAndIntersection) {
  Step step;
  step.face({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  step.face({1, 1, 0}, {1, 1, 2}, {1, 2, 2}, {0, 0, 1});
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contacts[vertex_face], 1u);
  EXPECT_EQ(result.initial_intersections, 1u);
  ASSERT_TRUE(result.first);
  EXPECT_EQ(result.first->first.end, 0);
}

/// Two faces joined by a hinge. The free corner of the second moves from `from` to `to`; that of the first stays at
/// (0, 1, 0).
Step hinge(const Position& from, const Position& to) {
  Step step;
  const VertexId a = step.vertex({-1, 0, 0}), b = step.vertex({1, 0, 0});
  const VertexId c = step.vertex({0, 1, 0}), d = step.vertex(from, to);
  step.mesh.faces = {{a, b, c}, {b, a, d}};
  return step;
}

TEST(Verifier, AHingeThatStaysOpenTouchesNothing) {
  const VerifyResult result = verify(hinge({0, -1, 0}, {0, 0.5, 0.5}));
  EXPECT_EQ(result.contact_count() + result.initial_intersections, 0u);
}

TEST(Verifier, AHingeThatFoldsOntoItselfTouches) {
  const VerifyResult result = verify(hinge({0, 0.5, 1}, {0, 0.5, 0}));
  EXPECT_EQ(result.contacts[vertex_face], 1u);  // d ends up on abc
  EXPECT_EQ(result.initial_intersections, 0u);
  const VerifyResult flat = verify(hinge({0, 0.5, 0}, {0, 0.5, 1}));
  EXPECT_EQ(flat.contacts[vertex_face], 1u);
  EXPECT_EQ(flat.initial_intersections, 1u);
}

/// Two faces around the corner at the origin.
Step fan(const Position& d, const Position& e) {
  Step step;
  const VertexId a = step.vertex({0, 0, 0});
  const VertexId b = step.vertex({2, -1, 0}), c = step.vertex({2, 1, 0});
  step.mesh.faces = {{a, b, c}, {a, step.vertex(d), step.vertex(e)}};
  return step;
}

TEST(Verifier, FacesAroundACornerMeetOnlyBesideIt) {
  EXPECT_EQ(verify(fan({-2, 1, 0}, {-2, -1, 0})).initial_intersections, 0u);
  EXPECT_EQ(verify(fan({1, 0, 1}, {1, 0, 2})).initial_intersections, 0u);
  const VerifyResult pierced = verify(fan({1, 0, 1}, {1, 0, -1}));
  EXPECT_EQ(pierced.initial_intersections, 1u);
  EXPECT_EQ(pierced.contact_count(), 0u);
}

TEST(Verifier, FacesOnTheSameVerticesAreNotCompared) {
  Step step = hinge({0, -1, 0}, {0, -1, 0});
  step.mesh.faces = {{0, 1, 2}, {2, 1, 0}};
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contact_count() + result.initial_intersections, 0u);
}

TEST(Verifier, VerticesAtTheSamePlaceAreDifferentVertices) {
  Step step;
  step.face({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  step.face({0, 0, 0}, {-1, 0, 0}, {0, -1, 0});
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contacts[vertex_face], 2u);
  EXPECT_EQ(result.contacts[edge_edge], 4u);
  EXPECT_EQ(result.initial_intersections, 1u);
}

TEST(Verifier, AFaceThatIsASegmentByIndexCounts) {
  Step step;
  const VertexId a = step.vertex({0, 0, -1}, {1, 1, -1}), b = step.vertex({0, 0, 1}, {1, 1, 1});
  step.mesh.faces = {{a, b, b}};
  step.face({2, 0, 0}, {0, 2, 0}, {3, 3, 0});
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contacts[vertex_face], 0u);
  EXPECT_EQ(result.contacts[edge_edge], 1u);  // ab comes to (1, 1) on the edge from (2, 0) to (0, 2)
}

TEST(Verifier, LooseEdgesAndPointsCountByTheirKind) {
  Step step;
  const VertexId a = step.vertex({-1, 0, 0}), b = step.vertex({1, 0, 0});
  const VertexId p = step.vertex({0, 0, 1}, {0, 0, 0}), q = step.vertex({0, 0, -1}, {0, 0, 0});
  step.mesh.edges = {{a, b}};
  step.mesh.points = {p, q};
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contacts[vertex_edge], 2u);
  EXPECT_EQ(result.contacts[vertex_vertex], 1u);
  EXPECT_EQ(result.contacts[vertex_face] + result.contacts[edge_edge], 0u);
  EXPECT_EQ(result.initial_intersections, 0u);
}

TEST(Verifier, ALoosePointAgainstAFaceIsVertexFace) {
  Step step;
  step.face({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  step.mesh.points = {step.vertex({1, 1, 1}, {1, 1, -1}), step.vertex({3, 3, 1}, {3, 3, -1})};
  EXPECT_EQ(verify(step).contacts, (std::array<std::uint64_t, 4>{1, 0, 0, 0}));
}

TEST(Verifier, StrictAlsoLooksAtTheFeaturesOfOneCell) {
  Step step;
  const VertexId a = step.vertex({0, 1, 0}, {0, -1, 0}), b = step.vertex({-1, 0, 0}), c = step.vertex({1, 0, 0});
  step.mesh.faces = {{a, b, c}};  // a goes through the edge bc
  EXPECT_EQ(verify(step).contact_count(), 0u);
  const VerifyResult result = verify(step, strictly());
  EXPECT_EQ(result.contacts, (std::array<std::uint64_t, 4>{0, 0, 1, 0}));
  ASSERT_EQ(result.reports.size(), 1u);
  EXPECT_EQ(result.reports[0].vertices, (std::array<VertexId, 4>{a, b, c, 0}));
  step.x_t1[a] = {0, 2, 0};
  EXPECT_EQ(verify(step, strictly()).contact_count(), 0u);
}

TEST(Verifier, StrictLooksAtTheEndsOfALooseEdge) {
  Step step;
  step.mesh.edges = {{step.vertex({0, 0, 0}), step.vertex({1, 0, 0}, {-1, 0, 0})}};
  EXPECT_EQ(verify(step).contact_count(), 0u);
  EXPECT_EQ(verify(step, strictly()).contacts, (std::array<std::uint64_t, 4>{0, 0, 0, 1}));
}

TEST(Verifier, StrictCountsAPairOfFeaturesOnce) {
  Step step;
  const VertexId a = step.vertex({0, 1, 0}, {0, -1, 0}), b = step.vertex({-1, 0, 0}), c = step.vertex({1, 0, 0});
  step.mesh.faces = {{a, b, c}};
  step.mesh.edges = {{c, b}};
  const std::array<std::uint64_t, 4> one = {0, 0, 1, 0};
  EXPECT_EQ(verify(step, strictly()).contacts, one) << "a corner, no cell, against the loose edge";
  step.mesh.points = {a};  // now a pair of two cells, which counts without `strict`
  EXPECT_EQ(verify(step).contacts, one);
  EXPECT_EQ(verify(step, strictly()).contacts, one);
  const WorldLines lines = WorldLines::from_frames(step.x_t0, step.x_t1);
  WindowOptions window;
  EXPECT_EQ(verify_window(step.mesh, lines, window).contacts, one);
  window.strict = true;
  EXPECT_EQ(verify_window(step.mesh, lines, window).contacts, one);
  Step closing;
  const VertexId p = closing.vertex({0, 0, 0}), q = closing.vertex({1, 0, 0}, {-1, 0, 0});
  closing.mesh.edges = {{p, q}};
  closing.mesh.points = {p, q};
  for (const bool strict : {false, true}) {
    EXPECT_EQ(verify(closing, strict ? strictly() : VerifyOptions()).contacts,
              (std::array<std::uint64_t, 4>{0, 0, 0, 1}));
  }
}

TEST(Verifier, In2DTheThirdCoordinateIsNotLookedAt) {
  Step step;
  step.face({0, 0, 7}, {4, 0, -3}, {0, 4, 1});
  step.face({5, 1, 0}, {6, 1, 0}, {6, 2, 0}, {-3.5, 0, 9});
  const VerifyResult result = verify(step, in_2d());
  EXPECT_GT(result.contacts[vertex_edge], 0u);
  EXPECT_EQ(result.contacts[vertex_face] + result.contacts[edge_edge], 0u);
  EXPECT_EQ(result.initial_intersections, 0u);
}

TEST(Verifier, In2DAPointInsideAFaceIsAnIntersectionWithoutEvent) {
  Step step;
  step.face({0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {1, 0, 0});
  step.mesh.points = {step.vertex({1, 1, 0}, {2, 1, 0}), step.vertex({7, 7, 0})};
  const VerifyResult result = verify(step, in_2d());
  EXPECT_EQ(result.contact_count(), 0u);
  EXPECT_EQ(result.initial_intersections, 1u);
}

TEST(Verifier, In2DEdgesThatCrossThroughoutAreAnIntersectionWithoutEvent) {
  Step step;
  step.mesh.edges = {{step.vertex({-1, 0, 0}), step.vertex({1, 0, 0})},
                     {step.vertex({0, -1, 0}), step.vertex({0, 1, 0})}};
  const VerifyResult result = verify(step, in_2d());
  EXPECT_EQ(result.contact_count(), 0u);
  EXPECT_EQ(result.initial_intersections, 1u);
}

TEST(Verifier, TheFirstContactIsTheEarliest) {
  Step step;
  step.face({0, 0, 0}, {9, 0, 0}, {0, 9, 0});
  step.mesh.points = {step.vertex({1, 1, 3}, {1, 1, -1}), step.vertex({2, 1, 2}, {2, 1, -4}),
                      step.vertex({3, 1, 1}, {3, 1, -2})};
  const VerifyResult result = verify(step);  // at 3/4, 1/3, 1/3
  EXPECT_EQ(result.contacts[vertex_face], 3u);
  ASSERT_TRUE(result.first);
  EXPECT_EQ(result.first->vertices[0], 4u);  // of two first contacts, the one with smaller vertex numbers
  EXPECT_LT(result.first->first.begin, 1.0 / 3 + 0x1p-50);
  EXPECT_GT(result.first->first.end, 1.0 / 3 - 0x1p-50);
}

TEST(Verifier, ReportsAreTheFirstInCanonicalOrderAndCountsAreExact) {
  const Step step = two_sheets(7, 12, 0.8);
  VerifyOptions options;
  options.max_reports = 1000;
  const VerifyResult all = verify(step, options);
  ASSERT_GT(all.contact_count(), 20u);
  ASSERT_LE(all.contact_count(), 1000u);
  EXPECT_EQ(all.reports.size(), all.contact_count());
  options.max_reports = 5;
  const VerifyResult few = verify(step, options);
  EXPECT_EQ(few.contacts, all.contacts);
  ASSERT_EQ(few.reports.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(few.reports[i], all.reports[i]);
}

TEST(Verifier, FirstOnlyEndsWithAContactAndOneThatDependsOnNothing) {
  const Step step = two_sheets(7, 12, 0.8);
  VerifyOptions options;
  options.first_only = true;
  options.threads = 1;
  const VerifyResult once = verify(step, options);
  EXPECT_FALSE(once.complete);
  EXPECT_EQ(once.contact_count() > 0, true);
  ASSERT_TRUE(once.first);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const VerifyResult again = verify(step, options);
    EXPECT_EQ(again.first, once.first);
    EXPECT_EQ(again.contacts, once.contacts);
    EXPECT_EQ(again.stages, once.stages);
    EXPECT_EQ(again.obligations, once.obligations);
  }
}

TEST(Verifier, FirstOnlyIsCompleteWhenThereIsNothing) {
  VerifyOptions options;
  options.first_only = true;
  EXPECT_TRUE(verify(two_sheets(7, 6, 0), options).complete);
}

TEST(Verifier, AStopIsNoticedAndSaidSo) {
  std::atomic<bool> stop = true;
  VerifyOptions options;
  options.stop = &stop;
  EXPECT_FALSE(verify(two_sheets(7, 30, 0.8), options).complete);
  stop = false;
  EXPECT_TRUE(verify(two_sheets(7, 30, 0.8), options).complete);
}

TEST(Verifier, ADeadlineIsNoticedAndSaidSo) {
  VerifyOptions options;
  options.deadline = std::chrono::steady_clock::now();
  EXPECT_FALSE(verify(two_sheets(7, 30, 0.8), options).complete);
  options.deadline = std::chrono::steady_clock::now() + std::chrono::hours(1);
  EXPECT_TRUE(verify(two_sheets(7, 30, 0.8), options).complete);
}

TEST(Verifier, ProgressGoesFromSomethingToAll) {
  std::vector<double> told;
  VerifyOptions options;
  options.threads = 2;
  options.progress = [&told](double share) { told.push_back(share); };
  verify(two_sheets(7, 30, 0.8), options);
  ASSERT_GT(told.size(), 2u);
  EXPECT_GT(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

TEST(Verifier, ScaleDoesNotChangeAnything) {
  const Step step = two_sheets(5, 12, 0.8);
  const VerifyResult plain = verify(step);
  ASSERT_GT(plain.contact_count(), 0u);
  for (const double scale : {0x1p1010, 0x1p600, 0x1p-600, 0x1p-940}) {
    Step scaled = step;
    for (auto* x : {&scaled.x_t0, &scaled.x_t1}) {
      for (Position& p : *x) {
        for (double& c : p) c *= scale;
      }
    }
    const VerifyResult result = verify(scaled);
    EXPECT_EQ(result.contacts, plain.contacts);
    EXPECT_EQ(result.reports, plain.reports);
    EXPECT_EQ(result.initial_intersections, plain.initial_intersections);
  }
}

TEST(Verifier, TheGreatestCoordinatesAreAllowed) {
  constexpr double most = std::numeric_limits<double>::max();
  Step step;
  step.face({-most, -most, 0}, {most, -most, 0}, {0, most, 0});
  step.mesh.points = {step.vertex({0, 0, -most}, {0, 0, most}), step.vertex({most, most, -most}, {most, most, most})};
  const VerifyResult result = verify(step);
  EXPECT_EQ(result.contacts, (std::array<std::uint64_t, 4>{1, 0, 0, 0}));
  ASSERT_TRUE(result.first);
  EXPECT_EQ(result.first->first.begin, 0.5);
  EXPECT_EQ(result.first->first.end, 0.5);
}

TEST(Verifier, ThreadsDoNotChangeAnything) {
  const Step step = two_sheets(11, 40, 0.8);
  VerifyOptions options;
  options.threads = 1;
  const VerifyResult one = verify(step, options);
  ASSERT_GT(one.contact_count(), 0u);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const VerifyResult many = verify(step, options);
    EXPECT_EQ(many.contacts, one.contacts);
    EXPECT_EQ(many.reports, one.reports);
    EXPECT_EQ(many.initial_reports, one.initial_reports);
    EXPECT_EQ(many.first, one.first);
    EXPECT_EQ(many.first->first.begin, one.first->first.begin);
    EXPECT_EQ(many.stages, one.stages);
    EXPECT_EQ(many.obligations, one.obligations);
    EXPECT_EQ(many.cell_pairs, one.cell_pairs);
  }
}

}  // namespace
}  // namespace noli::testing
