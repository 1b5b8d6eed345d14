// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/minimise_query.h"

#include <gtest/gtest.h>

#include "audit/fuzz/queries/judge.h"

namespace noli::audit {
namespace {

AnyQuery complicated() {
  AnyQuery query;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      query.x_t0[i][axis] = 1.1 * static_cast<double>(i + 1) + static_cast<double>(axis);
      query.x_t1[i][axis] = -3.3e5 * static_cast<double>(axis + 1) - static_cast<double>(i);
    }
  }
  return query;
}

TEST(Complexity, GrowsWithBitsExponentAndSign) {
  EXPECT_EQ(complexity(0.0), 0);
  EXPECT_EQ(complexity(-0.0), 1);
  EXPECT_LT(complexity(1.0), complexity(-1.0));
  EXPECT_LT(complexity(1.0), complexity(3.0));
  EXPECT_LT(complexity(1.0), complexity(0x1p-1074));
  EXPECT_LT(complexity(1.5), complexity(1.1));
}

TEST(Minimise, LeavesNothingThatIsNotNeeded) {
  const auto fails = [](const AnyQuery& query) { return query.x_t1[2][1] < -1000; };
  const AnyQuery result = minimise(complicated(), fails);
  EXPECT_TRUE(fails(result));
  EXPECT_LT(complexity(result), 20);
  EXPECT_EQ(result.x_t0, (std::array<Point3, 4>{}));
}

TEST(Minimise, PrefersFewDifferentNumbers) {
  // Compares two sums whose terms may be any numbers.
  const auto fails = [](const AnyQuery& query) {
    const double a = query.x_t0[0][0] + query.x_t0[1][1], b = query.x_t1[2][2] + query.x_t1[3][0];
    return a > 2.5 && b > a;
  };
  AnyQuery query = complicated();
  query.x_t1[2][2] = 1e6;
  query.x_t1[3][0] = 7.7;
  ASSERT_TRUE(fails(query));
  const AnyQuery result = minimise(query, fails);
  EXPECT_TRUE(fails(result));
  EXPECT_LE(distinct_coordinates(result), 3U);
}

TEST(Minimise, CountsDifferentNumbersOnce) {
  AnyQuery query;
  EXPECT_EQ(distinct_coordinates(query), 1U);
  query.x_t0[0] = {1, -1, -0.0};
  query.x_t1[3] = {1, 1, 0.5};
  EXPECT_EQ(distinct_coordinates(query), 4U);
}

TEST(Minimise, AsksForManyAtATime) {
  std::size_t calls = 0;
  const FirstFailure first_failure = [&](std::span<const AnyQuery> candidates) -> std::optional<std::size_t> {
    ++calls;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (candidates[i].x_t1[2][1] < -1000) return i;
    }
    return std::nullopt;
  };
  const AnyQuery result = minimise(complicated(), first_failure);
  EXPECT_LT(complexity(result), 20);
  EXPECT_LT(calls, 300U);
}

TEST(Minimise, KeepsWhatIsNeeded) {
  const AnyQuery query = complicated();
  EXPECT_EQ(minimise(query, [&](const AnyQuery& candidate) { return candidate == query; }), query);
}

TEST(Minimise, RespectsItsBudget) {
  std::size_t calls = 0;
  minimise(
      complicated(), [&](const AnyQuery&) { return ++calls > 0; }, 7);
  EXPECT_EQ(calls, 7U);
}

TEST(Minimise, TouchesOnlyWhatCounts) {
  AnyQuery query = complicated();
  query.pair = FeaturePair::vertex_vertex;
  query.dimension = 2;
  const AnyQuery result = minimise(query, [](const AnyQuery&) { return true; });
  EXPECT_EQ(complexity(result), 0);
  EXPECT_EQ(result.x_t0[3], query.x_t0[3]);
  EXPECT_EQ(result.x_t0[0][2], query.x_t0[0][2]);
}

}  // namespace
}  // namespace noli::audit
