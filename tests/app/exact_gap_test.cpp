// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/exact_gap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace noli {
namespace {

struct Breakpoint {
  double t;
  Position x;
};

WorldLines lines_of(const std::vector<std::vector<Breakpoint>>& all) {
  std::vector<std::size_t> offsets = {0};
  std::vector<double> times;
  std::vector<Position> positions;
  for (const auto& of_vertex : all) {
    for (const auto& [t, x] : of_vertex) {
      times.push_back(t);
      positions.push_back(x);
    }
    offsets.push_back(times.size());
  }
  return WorldLines::from_breakpoints(std::move(offsets), std::move(times), std::move(positions), "test");
}

std::vector<Breakpoint> resting(const Position& x) { return {{0, x}, {0.3, x}, {1, x}}; }

TEST(ExactGap, OfAPointThatBouncesIsItsLowestHeight) {
  const WorldLines lines =
      lines_of({{{0, {0, 1, 0}}, {0.5, {0.2, 0.1, 0}}, {1, {0.3, 1, 0}}}, resting({-1, 0, 0}), resting({1, 0, 0})});
  const ExactGap gap = exact_gap(lines, 2, FeaturePair::vertex_edge, {0, 1, 2, 0});
  EXPECT_EQ(gap.up_to, 0.1);
  EXPECT_EQ(gap.above, std::nextafter(0.1, 0));
  EXPECT_NEAR(gap.time, 0.5, 1e-12);
}

/// Whether n d^2 < m, in integers. Preconditions: d in [1/4, 1/2), n and m below 2^11.
bool square_is_below(double d, unsigned n, unsigned m) {
  __extension__ using Wide = unsigned __int128;
  const auto scaled = static_cast<Wide>(static_cast<std::uint64_t>(d * 0x1p54));
  return n * scaled * scaled < Wide{m} << 108;
}

void expect_root(const ExactGap& gap, unsigned n, unsigned m) {
  EXPECT_EQ(std::nextafter(gap.above, 1), gap.up_to);
  EXPECT_TRUE(square_is_below(gap.above, n, m));
  EXPECT_FALSE(square_is_below(gap.up_to, n, m));
}

/// The line from (-1, 1/4) to (1, 1/2) passes the origin at a distance of 3 / sqrt(65).
TEST(ExactGap, BetweenBreakpointsIsDecidedInRealNumbers) {
  const WorldLines lines = lines_of({{{0, {-1, 0.25, 0}}, {1, {1, 0.5, 0}}}, resting({0, 0, 0})});
  for (const int dimension : {2, 3}) {
    expect_root(exact_gap(lines, dimension, FeaturePair::vertex_vertex, {0, 1, 0, 0}), 65, 9);
  }
}

/// The edges are nearest at 0.25 s, when the line through (-1, 3/8) and (1, 9/16) passes the other one at a distance of
/// 15 / sqrt(1033).
TEST(ExactGap, OfEdgesThatCrossAboveEachOther) {
  const WorldLines lines = lines_of({{{0, {-1, 0, 0.75}}, {0.25, {-1, 0, 0.375}}, {1, {-1, 0, 1}}},
                                     {{0, {1, 0, 0.75}}, {0.5, {1, 0, 0.375}}, {1, {1, 0, 1}}},
                                     resting({0, -1, 0}),
                                     resting({0, 1, 0})});
  const ExactGap gap = exact_gap(lines, 3, FeaturePair::edge_edge, {0, 1, 2, 3});
  expect_root(gap, 1033, 225);
  EXPECT_NEAR(gap.time, 0.25, 1e-9);
}

TEST(ExactGap, OfAVertexAndAFace) {
  const WorldLines lines = lines_of({{{0, {0.25, 0.25, 1}}, {0.75, {0.25, 0.25, 0x1p-40}}, {1, {0.25, 0.25, 1}}},
                                     resting({0, 0, 0}),
                                     resting({1, 0, 0}),
                                     resting({0, 1, 0})});
  const ExactGap gap = exact_gap(lines, 3, FeaturePair::vertex_face, {0, 1, 2, 3});
  EXPECT_EQ(gap.up_to, 0x1p-40);
  EXPECT_EQ(gap.above, std::nextafter(0x1p-40, 0));
}

TEST(ExactGap, ContactHasNone) {
  const WorldLines lines = lines_of({{{0, {0, 1, 0}}, {1, {0, -1, 0}}}, resting({-1, 0, 0}), resting({1, 0, 0})});
  const ExactGap gap = exact_gap(lines, 2, FeaturePair::vertex_edge, {0, 1, 2, 0});
  EXPECT_EQ(gap.up_to, 0);
  EXPECT_EQ(gap.above, 0);
  EXPECT_EQ(gap.time, 0.5);
}

TEST(ExactGap, IsFarWhereThingsAreFar) {
  const WorldLines lines = lines_of({{{0, {0, 1e300, 0}}, {1, {1, 1e300, 0}}}, resting({0, 0, 0})});
  EXPECT_EQ(exact_gap(lines, 2, FeaturePair::vertex_vertex, {0, 1, 0, 0}).up_to, 1e300);
}

}  // namespace
}  // namespace noli
