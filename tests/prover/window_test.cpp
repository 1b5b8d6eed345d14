// SPDX-License-Identifier: Apache-2.0
//
// Tests small windows made by hand, each with the answer that follows from the definitions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "window_scenes.h"

namespace noli::testing {
namespace {

constexpr auto vertex_face = static_cast<std::size_t>(FeaturePair::vertex_face);
constexpr auto edge_edge = static_cast<std::size_t>(FeaturePair::edge_edge);
constexpr auto vertex_edge = static_cast<std::size_t>(FeaturePair::vertex_edge);

WindowResult verify(const LineScene& scene, const WindowOptions& options = {}) {
  return verify_window(scene.mesh, scene.lines(), options);
}

WindowOptions in_2d() {
  WindowOptions options;
  options.dimension = 2;
  return options;
}

/// A face in the plane z = 0 over [0, 3], and a loose point above (1, 1) with the given heights.
LineScene point_over_face(const std::vector<std::pair<double, double>>& heights) {
  LineScene scene;
  std::vector<Breakpoint> path;
  for (const auto& [t, z] : heights) path.push_back({t, {1, 1, z}});
  scene.mesh.points = {scene.vertex(path)};
  scene.face({0, 0, 0}, {9, 0, 0}, {0, 9, 0});
  return scene;
}

TEST(Window, NothingToVerifyIsComplete) {
  LineScene scene;
  scene.vertex({{0, {}}, {1, {}}});
  const WindowResult result = verify(scene);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.contact_count(), 0u);
  EXPECT_FALSE(result.first);
}

TEST(Window, ADetourBetweenApartEndsMeets) {
  const WindowResult result = verify(point_over_face({{0, 1}, {1, -1}, {3, 1}}));
  EXPECT_EQ(result.contacts[vertex_face], 1u);
  EXPECT_EQ(result.contact_count(), 1u);
  ASSERT_TRUE(result.first);
  EXPECT_EQ(result.first->contact.vertices, (std::array<VertexId, 4>{0, 1, 2, 3}));
  EXPECT_EQ(result.first->lower(), 0.5);
  EXPECT_EQ(result.first->kind, ContactKind::crossing);
  ASSERT_EQ(result.reports.size(), 1u);
  EXPECT_LE(result.reports[0].first.begin, 0.5);
  EXPECT_GE(result.reports[0].first.end, 0.5);
}

TEST(Window, ADetourAwayFromADirectContactMeetsNothing) {
  // The straight line from (1, 1, 1) to (1, 1, -1) passes through the face; the point goes around it.
  LineScene scene;
  scene.mesh.points = {scene.vertex({{0, {1, 1, 1}}, {1, {-5, -5, 1}}, {2, {-5, -5, -1}}, {3, {1, 1, -1}}})};
  scene.face({0, 0, 0}, {9, 0, 0}, {0, 9, 0});
  const WindowResult result = verify(scene);
  EXPECT_EQ(result.contact_count(), 0u);
  EXPECT_FALSE(result.first);
  EXPECT_GT(result.obligations, 1u);
}

TEST(Window, AStopJustShortOfTheFaceMeetsNothing) {
  EXPECT_EQ(verify(point_over_face({{0, 1}, {1, 0x1p-1000}, {3, 1}})).contact_count(), 0u);
  EXPECT_EQ(verify(point_over_face({{0, 1}, {1, 0}, {3, 1}})).contact_count(), 1u);
}

TEST(Window, KindAtABreakpoint) {
  const auto kind = [](double after) { return verify(point_over_face({{0, 1}, {1, 0}, {3, after}})).first->kind; };
  EXPECT_EQ(kind(1), ContactKind::touching);
  EXPECT_EQ(kind(-1), ContactKind::crossing);
  EXPECT_EQ(kind(0), ContactKind::persistent);
  EXPECT_EQ(verify(point_over_face({{0, 1}, {1, 0}, {3, -1}})).first->lower(), 1);
}

TEST(Window, KindAtTheEnds) {
  const WindowResult end = verify(point_over_face({{0, 1}, {1, 2}, {3, 0}}));
  EXPECT_EQ(end.first->kind, ContactKind::touching);
  EXPECT_EQ(end.first->lower(), 3);
  const WindowResult begin = verify(point_over_face({{0, 0}, {1, 2}, {3, 1}}));
  EXPECT_EQ(begin.first->kind, ContactKind::touching);
  EXPECT_EQ(begin.first->lower(), 0);
  EXPECT_EQ(begin.initial_intersections, 1u);
  EXPECT_EQ(verify(point_over_face({{0, 0}, {1, 0}, {3, 1}})).first->kind, ContactKind::persistent);
}

/// Borders between pieces of the recursion are not kinks of the motion, and neither is a breakpoint of a third vertex.
TEST(Window, ABreakpointOfAnotherVertexDoesNotChangeTheKind) {
  LineScene scene = point_over_face({{0, 1}, {2, -1}, {3, 1}});
  // A corner of the face's neighbour has a breakpoint exactly at the time of the crossing.
  scene.paths.push_back({{0, {9, 9, 0}}, {1, {9, 9, 5}}, {3, {9, 9, 0}}});
  ++scene.mesh.vertex_count;
  scene.mesh.faces.push_back({2, 4, 3});
  const WindowResult result = verify(scene);
  ASSERT_TRUE(result.first);
  EXPECT_EQ(result.first->lower(), 1);
  EXPECT_EQ(result.first->kind, ContactKind::crossing);
}

TEST(Window, APairCountsOnceHoweverOftenItMeets) {
  const WindowResult result = verify(point_over_face({{0, 1}, {0.5, -1}, {1, 1}, {1.5, -1}, {2, 1}, {3, -1}}));
  EXPECT_EQ(result.contact_count(), 1u);
  EXPECT_EQ(result.first->lower(), 0.25);
}

TEST(Window, TimesThatAreNoDoublesAreRoundedDown) {
  const WindowResult result = verify(point_over_face({{0, 1}, {1, 2}, {3, -4}}));  // at 1 + 2/3
  EXPECT_EQ(result.first->lower(), 0x1.aaaaaaaaaaaaap0);
  EXPECT_EQ(result.first->contact.first.end, std::nextafter(result.first->lower(), 2));
}

TEST(Window, TheFirstOfAllIsTheEarliestThenTheLeast) {
  LineScene scene = point_over_face({{0, 1}, {1, 3}, {3, -1}});  // at 2.5
  const auto add = [&](double x, double t, double z) {
    scene.mesh.points.push_back(scene.vertex({{0, {x, 1, 1}}, {t, {x, 1, z}}, {3, {x, 1, z}}}));
  };
  add(2, 3.0 / 4, -0.5);  // at 1/2
  add(3, 1, -1);          // at 1/2
  add(4, 2, -1);          // at 1
  const WindowResult result = verify(scene);
  EXPECT_EQ(result.contact_count(), 4u);
  EXPECT_EQ(result.first->lower(), 0.5);
  EXPECT_EQ(result.first->contact.vertices[0], 4u);
}

TEST(Window, AnEdgeThatPiercesThroughoutIsAnIntersectionWithoutEvent) {
  LineScene scene;
  const VertexId a = scene.vertex({{0, {2, 2, -4}}, {0.5, {3, 2, -4}}, {1, {2, 2, -4}}});
  const VertexId b = scene.vertex({{0, {2, 2, 4}}, {0.3, {2, 2, 5}}, {1, {2, 3, 4}}});
  scene.mesh.edges = {{a, b}};
  scene.face({0, 0, 0}, {9, 0, 0}, {0, 9, 0});
  const WindowResult result = verify(scene);
  EXPECT_EQ(result.contact_count(), 0u);
  EXPECT_EQ(result.initial_intersections, 1u);
  ASSERT_EQ(result.initial_reports.size(), 1u);
  EXPECT_EQ(result.initial_reports[0], (InitialIntersection{0, 1}));
  WindowOptions options;
  options.initial = false;
  EXPECT_EQ(verify(scene, options).initial_intersections, 0u);
}

TEST(Window, EdgesMeetBetweenBreakpointsOfTheirOwn) {
  LineScene scene;
  const VertexId a = scene.vertex({{0, {-1, 0, 0}}, {0.7, {-1, 0, 0}}, {1, {-1, 0, 5}}});
  const VertexId b = scene.vertex({{0, {1, 0, 0}}, {0.6, {1, 0, 0}}, {1, {1, 0, 7}}});
  const VertexId c = scene.vertex({{0, {0, -1, 3}}, {0.5, {0, -1, -1}}, {1, {0, -1, 3}}});
  const VertexId d = scene.vertex({{0, {0, 1, 3}}, {0.5, {0, 1, -1}}, {1, {0, 1, 3}}});
  scene.mesh.faces = {{a, b, b}, {c, d, d}};
  const WindowResult result = verify(scene);
  EXPECT_EQ(result.contacts[edge_edge], 1u);
  EXPECT_EQ(result.first->lower(), 0.375);
  EXPECT_EQ(result.first->kind, ContactKind::crossing);
}

TEST(Window, InThePlaneTheThirdCoordinateIsNotLookedAt) {
  LineScene scene;
  const VertexId a = scene.vertex({{0, {-1, 0, 7}}, {1, {-1, 0, 9}}}), b = scene.vertex({1, 0, -3});
  const VertexId p = scene.vertex({{0, {0, 1, 0}}, {0.25, {0, -1, 100}}, {1, {0, 1, 0}}});
  scene.mesh.edges = {{a, b}};
  scene.mesh.points = {p};
  const WindowResult result = verify(scene, in_2d());
  EXPECT_EQ(result.contacts[vertex_edge], 1u);
  EXPECT_EQ(result.first->lower(), 0.125);
  EXPECT_EQ(result.first->kind, ContactKind::crossing);
  EXPECT_EQ(verify(scene).contact_count(), 0u);
}

// --- scripted pairs

TEST(Window, PairsOfScriptedCellsAreNotLookedAt) {
  LineScene scene = point_over_face({{0, 1}, {1, -1}, {3, -1}});
  const auto count = [&](std::vector<std::uint8_t> scripted) {
    WindowOptions options;
    options.scripted = scripted;
    return verify(scene, options).contact_count();
  };
  EXPECT_EQ(count({1, 1, 1, 1}), 0u);
  EXPECT_EQ(count({0, 1, 1, 1}), 1u);
  EXPECT_EQ(count({1, 1, 0, 1}), 1u);
  EXPECT_EQ(count({0, 0, 0, 0}), 1u);
  EXPECT_EQ(count({}), 1u);
}

TEST(Window, ExcludedPairsOfGroupsAreNotLookedAt) {
  LineScene scene = point_over_face({{0, 1}, {1, -1}, {3, -1}});  // vertex 0 is the point
  const auto count = [&](const Exclusions& exclusions) {
    WindowOptions options;
    options.exclusions = &exclusions;
    return verify(scene, options).contact_count();
  };
  EXPECT_EQ(count({{1, 0, 0, 0}, {{0, 1}}}), 0u);
  EXPECT_EQ(count({{1, 0, 0, 0}, {{0, 0}, {1, 1}}}), 1u);
  EXPECT_EQ(count({{4, 4, 4, 4}, {{4, 4}}}), 0u);
  EXPECT_EQ(count({{4, 4, 4, 4}, {{3, 4}}}), 1u);
  EXPECT_EQ(count({}), 1u);
}

TEST(Window, AScriptedVertexOfAFreeCellIsLookedAt) {
  // Vertex 0 belongs to a scripted face, which comes first, and to a free one, which makes its contact count.
  LineScene scene;
  const VertexId v = scene.vertex({{0, {1, 1, 1}}, {1, {1, 1, -1}}});
  const VertexId a = scene.vertex({1, 1, 5}), b = scene.vertex({2, 1, 5}), c = scene.vertex({1, 2, 6});
  scene.mesh.faces = {{v, a, b}, {v, b, c}};
  scene.face({0, 0, 0}, {9, 0, 0}, {0, 9, 0});
  WindowOptions options;
  const std::vector<std::uint8_t> scripted = {1, 1, 1, 0, 1, 1, 1};
  options.scripted = scripted;
  const WindowResult result = verify(scene, options);
  EXPECT_EQ(result.contacts[vertex_face], 1u);
  EXPECT_EQ(result.contacts[vertex_face], verify(scene).contacts[vertex_face]);
  const std::vector<std::uint8_t> all(7, 1);
  options.scripted = all;
  EXPECT_EQ(verify(scene, options).contact_count(), 0u);
}

TEST(Window, ScriptedEdgesOfFreeCellsAreLookedAt) {
  LineScene scene;
  const auto down = [&](double x, double y) { return scene.vertex({{0, {x, y, 1}}, {1, {x, y, -1}}}); };
  const VertexId a = down(-1, 0), b = down(1, 0);
  const VertexId up = scene.vertex({0, 0, 9}), free = scene.vertex({0, 0.5, 9});
  scene.mesh.faces = {{a, b, up}, {a, b, free}};
  const VertexId c = scene.vertex({0, -1, 0}), d = scene.vertex({0, 1, 0});
  scene.mesh.faces.push_back({c, d, d});
  WindowOptions options;
  const std::vector<std::uint8_t> scripted = {1, 1, 1, 0, 1, 1};
  options.scripted = scripted;
  EXPECT_EQ(verify(scene, options).contacts[edge_edge], 1u);
}

TEST(Window, ScriptedEdgesOfFreeCellsAreLookedAtWhereFreeCellsOwnAllCorners) {
  LineScene scene;
  const auto down = [&](double x, double y) { return scene.vertex({{0, {x, y, 1}}, {1, {x, y, -1}}}); };
  const VertexId a = down(-1, 0), b = down(1, 0), up = scene.vertex({0, 0, 9});
  const VertexId c = scene.vertex({0, -1, 0}), d = scene.vertex({0, 1, 0});
  const VertexId above = scene.vertex({0, 0.5, 9}), below = scene.vertex({0, 0, -9});
  for (const VertexId v : {a, b, up}) scene.mesh.faces.push_back({v, above, above});
  for (const VertexId v : {c, d}) scene.mesh.faces.push_back({v, below, below});
  scene.mesh.faces.insert(scene.mesh.faces.end(), {{a, b, up}, {c, d, d}, {a, b, above}});
  WindowOptions options;
  const std::vector<std::uint8_t> scripted = {1, 1, 1, 1, 1, 0, 0};
  options.scripted = scripted;
  EXPECT_EQ(verify(scene).contacts[edge_edge], 1u);
  EXPECT_EQ(verify(scene, options).contacts[edge_edge], 1u);
}

// --- ways to end

TEST(Window, FirstOnlyEndsWithAContactAndOneThatDependsOnNothing) {
  const LineScene scene = line_scene_of(two_sheets(7, 12, 0.8));
  WindowOptions options;
  options.first_only = true;
  options.threads = 1;
  const WindowResult once = verify(scene, options);
  EXPECT_FALSE(once.complete);
  ASSERT_TRUE(once.first);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const WindowResult again = verify(scene, options);
    EXPECT_EQ(again.first->contact, once.first->contact);
    EXPECT_EQ(again.contacts, once.contacts);
    EXPECT_EQ(again.stages, once.stages);
    EXPECT_EQ(again.obligations, once.obligations);
  }
  EXPECT_TRUE(verify(line_scene_of(two_sheets(7, 6, 0)), options).complete);
}

TEST(Window, AStopIsNoticedAndSaidSo) {
  const LineScene scene = line_scene_of(two_sheets(7, 30, 0.8));
  std::atomic<bool> stop = true;
  WindowOptions options;
  options.stop = &stop;
  EXPECT_FALSE(verify(scene, options).complete);
  stop = false;
  EXPECT_TRUE(verify(scene, options).complete);
  options.deadline = std::chrono::steady_clock::now();
  EXPECT_FALSE(verify(scene, options).complete);
  options.deadline = std::chrono::steady_clock::now() + std::chrono::hours(1);
  EXPECT_TRUE(verify(scene, options).complete);
}

TEST(Window, ProgressGoesFromSomethingToAll) {
  std::vector<double> told;
  WindowOptions options;
  options.threads = 2;
  options.progress = [&told](double share) { told.push_back(share); };
  verify(line_scene_of(two_sheets(7, 30, 0.8)), options);
  ASSERT_GT(told.size(), 2u);
  EXPECT_GT(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

TEST(Window, ReportsAreTheFirstInCanonicalOrderAndCountsAreExact) {
  const LineScene scene = line_scene_of(two_sheets(7, 12, 0.8));
  WindowOptions options;
  options.max_reports = 1000;
  const WindowResult all = verify(scene, options);
  ASSERT_GT(all.contact_count(), 20u);
  EXPECT_EQ(all.reports.size(), all.contact_count());
  options.max_reports = 5;
  const WindowResult few = verify(scene, options);
  EXPECT_EQ(few.contacts, all.contacts);
  ASSERT_EQ(few.reports.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(few.reports[i], all.reports[i]);
}

TEST(Window, WithTwoBreakpointsIsAStep) {
  for (const double fall : {0.0, 0.8, 1.5}) {
    const Step step = two_sheets(11, 25, fall);
    VerifyOptions options;
    options.max_reports = 1000000;
    const VerifyResult expected = verify_step(step.mesh, step.x_t0, step.x_t1, options);
    WindowOptions same;
    same.max_reports = options.max_reports;
    const WindowResult result = verify(line_scene_of(step), same);
    EXPECT_EQ(result.contacts, expected.contacts);
    EXPECT_EQ(result.reports, expected.reports);
    EXPECT_EQ(result.initial_reports, expected.initial_reports);
    ASSERT_EQ(result.first.has_value(), expected.first.has_value());
    EXPECT_EQ(result.first.has_value(), fall > 0);
    if (result.first) {
      EXPECT_EQ(result.first->contact, *expected.first);
      EXPECT_EQ(result.first->lower(), expected.first->first.begin);
    }
  }
}

// --- sizes

TEST(Window, TimesAndPlacesOfAnySizeAreRight) {
  constexpr double most = std::numeric_limits<double>::max();
  for (const double time : {1.0, 1e300, 1e-300, 0x1p-1072}) {
    for (const double place : {1.0, 1e300, 1e-290}) {
      LineScene scene;
      const auto at = [&](double z) { return Position{place, place, z * place}; };
      scene.mesh.points = {scene.vertex({{0, at(2)}, {time, at(2)}, {2 * time, at(-1)}, {4 * time, at(3)}})};
      scene.face({0, 0, 0}, {9 * place, 0, 0}, {0, 9 * place, 0});
      const WindowResult result = verify(scene);
      EXPECT_EQ(result.contacts[vertex_face], 1u) << time << " " << place;
      scene.paths[0][2].x = at(1);
      EXPECT_EQ(verify(scene).contact_count(), 0u) << time << " " << place;
    }
  }
  LineScene scene;
  scene.mesh.points = {scene.vertex({{-most, {0, 0, -most}}, {0, {0, 0, most}}, {most, {0, 0, most}}})};
  scene.face({-most, -most, 0}, {most, -most, 0}, {0, most, 0});
  const WindowResult result = verify(scene);
  EXPECT_EQ(result.contacts[vertex_face], 1u);
  EXPECT_EQ(result.first->lower(), -most / 2);
}

}  // namespace
}  // namespace noli::testing
