// SPDX-License-Identifier: Apache-2.0
//
// Decides a sequence of frames in memory step by step.
#include <noli/sequence.h>

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <utility>
#include <vector>

namespace noli {
namespace {

/// A triangle in the plane z = 0, and a loose point above it.
Mesh triangle_and_point() {
  Mesh mesh;
  mesh.vertex_count = 4;
  mesh.faces = {{0, 1, 2}};
  mesh.points = {3};
  return mesh;
}

std::vector<Position> point_at(double z) { return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, z}}; }

/// What a chain carries over from step to step changes no finding.
TEST(Sequence, StepsOfAChainFindWhatEachFindsAlone) {
  SequenceOptions options;
  options.max_reports = 1000;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1);
  Mesh mesh;
  mesh.vertex_count = 90;
  for (VertexId v = 0; v < 90; v += 3) mesh.faces.push_back({v, v + 1, v + 2});
  std::vector<Position> x(90);
  for (Position& p : x) p = {place(random), place(random), place(random)};
  SequenceVerifier chain(mesh, options);
  std::uint64_t contacts = 0;
  for (std::uint64_t step = 0; step < 40; ++step) {
    std::vector<Position> next = x;
    for (Position& p : next) p[step % 3] += 0.05 * (place(random) - 0.5);
    options.first_step = step == 0 ? 0 : 16;  // the first of a chain, with nothing before it
    SequenceVerifier alone(mesh, options);
    const StepResult found = chain.step(x, next), expected = alone.step(x, next);
    EXPECT_EQ(found.contacts, expected.contacts) << step;
    EXPECT_EQ(found.reports, expected.reports) << step;
    EXPECT_EQ(found.initial_reports, expected.initial_reports) << step;
    EXPECT_EQ(found.first.has_value(), expected.first.has_value()) << step;
    contacts += found.contact_count();
    x = std::move(next);
  }
  EXPECT_GT(contacts, 0U);
}

TEST(Sequence, TheFirstFrameIsNoStep) {
  SequenceVerifier verifier(triangle_and_point(), {});
  EXPECT_FALSE(verifier.add(point_at(1)));
  EXPECT_TRUE(verifier.add(point_at(0.5)));
}

TEST(Sequence, StepsWithoutAndWithContact) {
  SequenceVerifier verifier(triangle_and_point(), {});
  verifier.add(point_at(1));
  const auto apart = verifier.add(point_at(0.25));
  EXPECT_TRUE(apart->complete);
  EXPECT_FALSE(apart->touches());
  EXPECT_FALSE(apart->first);
  const auto through = verifier.add(point_at(-0.75));
  EXPECT_TRUE(through->complete);
  EXPECT_EQ(through->contacts[static_cast<std::size_t>(FeaturePair::vertex_face)], 1U);
  ASSERT_TRUE(through->first);
  EXPECT_EQ(through->first->kind, ContactKind::crossing);
  EXPECT_EQ(through->first->time, 0.25);
  EXPECT_EQ(through->first->contact.vertices, (std::array<VertexId, 4>{3, 0, 1, 2}));
}

TEST(Sequence, WhatMetAtTheEndOfAStepIsNotCountedAgain) {
  SequenceVerifier verifier(triangle_and_point(), {});
  verifier.add(point_at(1));
  EXPECT_EQ(verifier.add(point_at(0))->contact_count(), 1U);
  const auto leaves = verifier.add(point_at(1));
  EXPECT_EQ(leaves->contact_count(), 0U);
  EXPECT_TRUE(leaves->reports.empty());
}

/// The triangle of triangle_and_point(), a point that rests on it, and another one that falls.
TEST(Sequence, TheFirstOfAStepIsNoneThatGoesOn) {
  Mesh mesh = triangle_and_point();
  mesh.points.push_back(4);
  mesh.vertex_count = 5;
  const auto frame = [](double z) {
    std::vector<Position> x = point_at(0);
    x.push_back({0.5, 0.5, z});
    return x;
  };
  const Exclusions none;
  for (const int how : {0, 1, 2}) {
    SCOPED_TRACE(how);
    SequenceOptions options;
    options.first_only = how == 1;
    options.exclusions = how == 2 ? &none : nullptr;
    SequenceVerifier verifier(mesh, options);
    EXPECT_EQ(verifier.step(frame(1), frame(0.5)).contact_count(), 1U);
    const StepResult rests = verifier.step(frame(0.5), frame(0.25), true);
    EXPECT_TRUE(rests.complete);
    EXPECT_FALSE(rests.proof) << "a point rests on the triangle";
    EXPECT_EQ(rests.contact_count(), 0U);
    EXPECT_EQ(rests.going_on, 1U);
    EXPECT_FALSE(rests.first);
    const StepResult falls = verifier.step(frame(0.25), frame(-0.75));
    EXPECT_EQ(falls.contact_count(), 1U);
    ASSERT_TRUE(falls.first);
    EXPECT_EQ(falls.first->time, 0.25);
    EXPECT_EQ(falls.first->contact.vertices[0], 4U);
  }
}

TEST(Sequence, AStepThatTouchesCanBeTriedAgain) {
  SequenceVerifier verifier(triangle_and_point(), {});
  EXPECT_FALSE(verifier.step(point_at(1), point_at(0.5)).touches());
  EXPECT_TRUE(verifier.step(point_at(0.5), point_at(-0.5)).touches());
  EXPECT_TRUE(verifier.step(point_at(0.5), point_at(0)).touches());
  const StepResult shorter = verifier.step(point_at(0.5), point_at(0.25));
  EXPECT_TRUE(shorter.complete);
  EXPECT_FALSE(shorter.touches());
  EXPECT_EQ(shorter.going_on, 0U);
  EXPECT_EQ(verifier.step(point_at(0.25), point_at(-0.25)).contact_count(), 1U);
}

TEST(Sequence, AnotherAttemptSeesAllThatTheFirstOneSaw) {
  SequenceVerifier verifier(triangle_and_point(), {});
  for (const double z : {-1.0, 1.0, -0.5}) {
    const StepResult leaves = verifier.step(point_at(0), point_at(z));
    EXPECT_EQ(leaves.contact_count(), 1U) << z;
    EXPECT_EQ(leaves.initial_intersections, 1U) << z;
  }
  EXPECT_EQ(verifier.step(point_at(-0.5), point_at(-1)).contact_count(), 0U);
  SequenceVerifier at_rest_first(triangle_and_point(), {});
  EXPECT_EQ(at_rest_first.step(point_at(0), point_at(0)).contact_count(), 1U);
  EXPECT_EQ(at_rest_first.step(point_at(0), point_at(0)).contact_count(), 0U) << "the next step, and no attempt";
}

TEST(Sequence, AFrameAfterAnotherAttemptFollowsIt) {
  SequenceVerifier verifier(triangle_and_point(), {});
  verifier.add(point_at(1));
  EXPECT_TRUE(verifier.add(point_at(-1))->touches());
  EXPECT_FALSE(verifier.step(point_at(1), point_at(0.5)).touches());
  EXPECT_FALSE(verifier.add(point_at(0.25))->touches());
  EXPECT_TRUE(verifier.add(point_at(-0.25))->touches());
}

TEST(Sequence, WhatMeetsInTheFirstFrame) {
  SequenceVerifier verifier(triangle_and_point(), {});
  verifier.add(point_at(0));
  const auto leaves = verifier.add(point_at(1));
  EXPECT_EQ(leaves->contact_count(), 1U);
  EXPECT_EQ(leaves->initial_intersections, 1U);
  EXPECT_EQ(leaves->first->time, 0);
}

TEST(Sequence, FramesAtRest) {
  SequenceVerifier verifier(triangle_and_point(), {.at_rest = true});
  EXPECT_FALSE(verifier.add(point_at(1))->touches());
  EXPECT_TRUE(verifier.add(point_at(0))->touches());
  EXPECT_FALSE(verifier.add(point_at(-1))->touches());  // nothing moves through the triangle
}

TEST(Sequence, WhatIsExcludedIsNotCompared) {
  Exclusions exclusions;
  exclusions.groups = {0, 0, 0, 1};
  exclusions.pairs = {{0, 1}};
  SequenceVerifier verifier(triangle_and_point(), {.exclusions = &exclusions});
  verifier.add(point_at(1));
  EXPECT_FALSE(verifier.add(point_at(-1))->touches());
}

TEST(Sequence, WhatIntersectsInTheFirstFrameIsNotComparedIfOnlyNewContactsAreAsked) {
  SequenceVerifier verifier(triangle_and_point(), {.only_new = true});
  verifier.add(point_at(0));
  EXPECT_FALSE(verifier.add(point_at(1))->touches());
  EXPECT_FALSE(verifier.add(point_at(-1))->touches()) << "it is the same pair";
  EXPECT_EQ(verifier.baseline(point_at(0)), (std::vector<InitialIntersection>{{0, 1}}));

  SequenceVerifier apart(triangle_and_point(), {.only_new = true});
  apart.add(point_at(1));
  EXPECT_TRUE(apart.add(point_at(-1))->touches());
  EXPECT_TRUE(apart.baseline(point_at(1)).empty());
}

TEST(Sequence, OnlyNewContactsBesidesWhatIsExcluded) {
  Mesh mesh = triangle_and_point();
  mesh.vertex_count = 5;
  mesh.points = {3, 4};
  const auto points_at = [](double z, double w) {
    auto x = point_at(z);
    x.push_back({0.25, 0.5, w});
    return x;
  };
  Exclusions exclusions;
  exclusions.groups = {0, 0, 0, 1, 1};
  exclusions.pairs = {{1, 1}};
  SequenceVerifier verifier(mesh, {.exclusions = &exclusions, .only_new = true});
  verifier.add(points_at(0, 1));
  EXPECT_FALSE(verifier.add(points_at(-1, 0.5))->touches());
  const auto touched = verifier.add(points_at(1, -0.5));
  EXPECT_EQ(touched->contact_count(), 1U);
  EXPECT_EQ(touched->first->contact.vertices[0], 4U);
}

TEST(Sequence, InThePlaneTheThirdCoordinateIsNotLookedAt) {
  Mesh mesh;
  mesh.vertex_count = 3;
  mesh.edges = {{0, 1}};
  mesh.points = {2};
  const auto point_over = [](double y) { return std::vector<Position>{{0, 0, 0}, {1, 0, 0}, {0.5, y, 7}}; };
  SequenceVerifier plane(mesh, {.dimension = 2}), space(mesh, {});
  plane.add(point_over(1));
  space.add(point_over(1));
  EXPECT_TRUE(plane.add(point_over(-1))->touches());
  EXPECT_FALSE(space.add(point_over(-1))->touches());
}

TEST(Sequence, AStopLeavesTheStepIncomplete) {
  const std::atomic<bool> stop = true;
  SequenceVerifier verifier(triangle_and_point(), {.stop = &stop});
  verifier.add(point_at(1));
  EXPECT_FALSE(verifier.add(point_at(0.5))->complete);
}

TEST(Sequence, TwoAtOnceKnowNothingOfEachOther) {
  SequenceVerifier one(triangle_and_point(), {}), other(triangle_and_point(), {});
  one.add(point_at(1));
  other.add(point_at(-1));
  EXPECT_TRUE(one.add(point_at(0))->touches());
  EXPECT_FALSE(other.add(point_at(-2))->touches());
  EXPECT_FALSE(one.add(point_at(0.5))->touches());
}

}  // namespace
}  // namespace noli
