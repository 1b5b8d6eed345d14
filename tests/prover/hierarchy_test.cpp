// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <random>
#include <span>

#include "scenes.h"
#include "trajectory/cell_features.h"

namespace noli::testing {
namespace {

Hierarchy build(const Step& step, int threads = 1) { return Hierarchy(step.mesh, step.x_t0, step.x_t1, 3, threads); }

TEST(Hierarchy, HasEachCellOnce) {
  const Step step = two_sheets(3, 15, 0.5);
  const Hierarchy hierarchy = build(step);
  std::vector<std::uint32_t> cells(hierarchy.leaf_cells().begin(), hierarchy.leaf_cells().end());
  std::sort(cells.begin(), cells.end());
  std::vector<std::uint32_t> expected(step.mesh.cell_count());
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_EQ(cells, expected);
}

TEST(Hierarchy, DoesNotDependOnThreads) {
  const Step step = two_sheets(3, 40, 0.5);
  const Hierarchy one = build(step, 1), many = build(step, 5);
  EXPECT_TRUE(std::equal(one.leaf_cells().begin(), one.leaf_cells().end(), many.leaf_cells().begin()));
}

TEST(Hierarchy, ChildrenShareOutTheLeavesAndTheNodes) {
  const Group g = {10, 4, 7};
  EXPECT_EQ(g.left().count + g.right().count, g.count);
  EXPECT_EQ(g.left().begin, g.begin);
  EXPECT_EQ(g.right().begin, g.begin + g.left().count);
  EXPECT_EQ(g.left().node, 11u);
  EXPECT_EQ(g.right().node, 11u + 2 * g.left().count - 1);
}

/// Whether all corners of the leaves of p are above those of q along n, at one end of the step.
bool above(const Step& step, const std::vector<Position>& x, const Hierarchy& h, Group p, Group q,
           const std::array<double, 3>& n) {
  const auto axis =
      static_cast<std::size_t>(std::find_if(n.begin(), n.end(), [](double c) { return c != 0; }) - n.begin());
  const auto extreme = [&](Group g, double sign) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = g.begin; i < g.begin + g.count; ++i) {
      for (const VertexId v : corners(step.mesh, h.leaf_cells()[i])) least = std::min(least, sign * x[v][axis]);
    }
    return least;
  };
  return extreme(p, n[axis]) > -extreme(q, -n[axis]);
}

/// Descends the tree and counts separated pairs, open pairs and wrong claims.
void check_pairs(const Step& step, const Hierarchy& h, Group p, Group q, int& separated, int& open, int& wrong) {
  EXPECT_EQ(axis_separates(h.box_of(p.node), h.box_of(q.node)),
            separating_axes(h.box_of(p.node), h.box_of(q.node)) != 0);
  if (axis_separates(h.box_of(p.node), h.box_of(q.node))) {
    ++separated;
    const unsigned axes = separating_axes(h.box_of(p.node), h.box_of(q.node));
    ASSERT_NE(axes, 0u);
    const auto bit = static_cast<std::size_t>(std::countr_zero(axes));
    std::array<double, 3> n{};
    n[bit % 4] = bit < 4 ? 1 : -1;
    if (!above(step, step.x_t0, h, p, q, n) || !above(step, step.x_t1, h, p, q, n)) ++wrong;
    return;
  }
  ++open;
  if (p.is_leaf() && q.is_leaf()) return;
  const bool first = p.count >= q.count;
  const Group whole = first ? p : q;
  for (const Group part : {whole.left(), whole.right()}) {
    check_pairs(step, h, first ? part : p, first ? q : part, separated, open, wrong);
  }
}

void expect_true_axes(const Step& step) {
  const Hierarchy h = build(step);
  int separated = 0, open = 0, wrong = 0;
  check_pairs(step, h, h.root().left(), h.root().right(), separated, open, wrong);
  EXPECT_GT(separated, 0);
  EXPECT_GT(open, 0);
  EXPECT_EQ(wrong, 0);
}

TEST(Hierarchy, WhatItsBoxesSeparateIsSeparate) { expect_true_axes(two_sheets(3, 12, 0.5)); }

/// The same scene, scaled and moved: rounding to float must not separate what is not separate.
Step transformed(Step step, double scale, double offset) {
  for (auto* x : {&step.x_t0, &step.x_t1}) {
    for (Position& p : *x) {
      for (double& c : p) c = c * scale + offset;
    }
  }
  return step;
}

TEST(Hierarchy, BoxesHoldFarFromTheOriginAndAtEveryScale) {
  expect_true_axes(transformed(two_sheets(3, 12, 0.5), 1, 1e12));
  expect_true_axes(transformed(two_sheets(3, 12, 0.5), 1e300, 0));
  expect_true_axes(transformed(two_sheets(3, 12, 0.5), 1e-300, 0));
  expect_true_axes(transformed(two_sheets(3, 12, 0.5), 1e-320, 0));
}

TEST(Hierarchy, EqualCoordinatesAreInNoOrder) {
  Step step;
  step.face({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  step.face({1, 1, 0}, {2, 1, 0}, {1, 2, 0});  // touches the first one's box in x, y and z
  const Hierarchy h = build(step);
  EXPECT_FALSE(axis_separates(h.box_of(h.root().left().node), h.box_of(h.root().right().node)));
}

TEST(Hierarchy, AnOrderThatTurnsAroundSeparatesNothing) {
  Step step;
  step.face({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  step.face({5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {-10, 0, 0});
  const Hierarchy h = build(step);
  EXPECT_FALSE(axis_separates(h.box_of(h.root().left().node), h.box_of(h.root().right().node)));
}

/// The same mesh after the step, moved on by `by`.
Step next_step(const Step& step, double by) {
  Step next = step;
  next.x_t0 = step.x_t1;
  for (Position& x : next.x_t1) x[0] += by;
  return next;
}

void expect_no_wrong_claim(const Step& step, const Hierarchy& hierarchy) {
  int separated = 0, open = 0, wrong = 0;
  const Group root = hierarchy.root();
  check_pairs(step, hierarchy, root.left(), root.right(), separated, open, wrong);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(open + separated, 0);
}

TEST(Hierarchy, StaysWhereTheMeshMovesAsAWhole) {
  const Step step = two_sheets(3, 15, 0.5);
  Hierarchy hierarchy = build(step);
  const std::vector<std::uint32_t> before(hierarchy.leaf_cells().begin(), hierarchy.leaf_cells().end());
  const Step next = next_step(step, 0.25);
  EXPECT_TRUE(hierarchy.refit(next.mesh, next.x_t0, next.x_t1, 3, 1));
  EXPECT_TRUE(std::ranges::equal(hierarchy.leaf_cells(), before));
  expect_no_wrong_claim(next, hierarchy);
}

TEST(Hierarchy, IsMadeAnewWhereItsBoxesHaveGrown) {
  const Step step = two_sheets(3, 15, 0.5);
  Hierarchy hierarchy = build(step);
  Step next = next_step(step, 0);
  std::mt19937 random(1);  // neighbours are torn apart
  std::ranges::shuffle(next.x_t1, random);
  EXPECT_FALSE(hierarchy.refit(next.mesh, next.x_t0, next.x_t1, 3, 1));
  EXPECT_TRUE(std::ranges::equal(hierarchy.leaf_cells(), build(next).leaf_cells()));
  expect_no_wrong_claim(next, hierarchy);
}

TEST(Hierarchy, FitsTheSameBoxesOnAnyNumberOfThreads) {
  const Step step = two_sheets(3, 40, 0.5);
  const Step next = next_step(step, 0.25);
  Hierarchy one = build(step, 1), many = build(step, 5);
  EXPECT_EQ(one.refit(next.mesh, next.x_t0, next.x_t1, 3, 1), many.refit(next.mesh, next.x_t0, next.x_t1, 3, 5));
  for (std::size_t i = 0; i < 2 * one.leaf_cells().size() - 1; ++i) {
    const std::span a(&one.box_of(i), 1), b(&many.box_of(i), 1);
    ASSERT_TRUE(std::ranges::equal(std::as_bytes(a), std::as_bytes(b))) << i;
  }
}

}  // namespace
}  // namespace noli::testing
