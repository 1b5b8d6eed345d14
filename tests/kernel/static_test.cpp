// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "kernel/static_predicates.h"
#include "tests/kernel/hull_by_subsets.h"
#include "tests/kernel/random_numbers.h"

namespace noli {
namespace {

using test::Random;
using test::Vector;

template <std::size_t N>
struct Simplex {
  std::array<Point3, N> doubles;
  std::vector<Vector> integers;
};

/// A random simplex. Small coordinates make degenerate and touching simplices frequent; the scale is a power of two,
/// which does not change any answer.
template <std::size_t N>
Simplex<N> random_simplex(Random& random, int reach, bool flat, double scale) {
  Simplex<N> result;
  for (Point3& p : result.doubles) {
    Vector v{random.around_zero(reach), random.around_zero(reach), flat ? 0 : random.around_zero(reach)};
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(v[axis]) * scale;
    result.integers.push_back(v);
  }
  return result;
}

template <std::size_t N>
std::array<Point2, N> flattened(const std::array<Point3, N>& x) {
  std::array<Point2, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = {x[i][0], x[i][1]};
  return result;
}

const auto& unpacked(const std::array<Point3, 1>& x) { return x[0]; }
const auto& unpacked(const std::array<Point2, 1>& x) { return x[0]; }
template <class P, std::size_t N>
const auto& unpacked(const std::array<P, N>& x) {
  return x;
}

constexpr std::array scales = {1.0, 0x1p-1070, 0x1p1010, 0x1p-537, 0x1.8p-3};

/// Compares with brute force in space and in the plane, and expects both answers to occur often enough.
template <std::size_t N, std::size_t M>
void compare_with_hulls(std::uint64_t seed) {
  Random random(seed);
  std::array<int, 2> answers{};
  for (int i = 0; i < 20000; ++i) {
    const double scale = scales[static_cast<std::size_t>(random.below(scales.size()))];
    const int reach = 1 + random.below(4);
    const bool flat = random.below(2) == 0;
    const auto a = random_simplex<N>(random, reach, flat, scale);
    const auto b = random_simplex<M>(random, reach, flat, scale);
    const bool expected = test::hulls_meet(a.integers, b.integers);
    ++answers[expected];
    ASSERT_EQ(intersects(unpacked(a.doubles), unpacked(b.doubles)), expected) << "query " << i;
    if (!flat) continue;
    const auto a2 = flattened(a.doubles);
    const auto b2 = flattened(b.doubles);
    ASSERT_EQ(intersects(unpacked(a2), unpacked(b2)), expected) << "in the plane, query " << i;
  }
  EXPECT_GT(answers[0], 400);
  EXPECT_GT(answers[1], 400);
}

TEST(StaticPredicates, PointAndSegmentAsHulls) { compare_with_hulls<1, 2>(1); }
TEST(StaticPredicates, PointAndTriangleAsHulls) { compare_with_hulls<1, 3>(2); }
TEST(StaticPredicates, SegmentsAsHulls) { compare_with_hulls<2, 2>(3); }
TEST(StaticPredicates, SegmentAndTriangleAsHulls) { compare_with_hulls<2, 3>(4); }
TEST(StaticPredicates, TrianglesAsHulls) { compare_with_hulls<3, 3>(5); }

TEST(StaticPredicates, OrientationSeesOneUlp) {
  const Point3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(orientation(a, b, c, {0.3, 0.3, 0x1p-1074}), 1);
  EXPECT_EQ(orientation(a, b, c, {0.3, 0.3, 0}), 0);
  EXPECT_EQ(orientation(a, b, c, {0.3, 0.3, -0x1p-1074}), -1);
  const double x = 1.0 / 3;
  EXPECT_EQ(orientation(Point2{0, 0}, {1, x}, {3, 3 * x}), 1);  // 3 x rounds to 1, but is less
}

TEST(StaticPredicates, OrientationOfPointsNearlyOnALine) {
  const Point2 a{12, 12}, b{24, 24};
  const double ulp = 0x1p-53;
  for (int i = -8; i <= 8; ++i) {
    for (int j = -8; j <= 8; ++j) {
      const Point2 c{0.5 + i * ulp * 2, 0.5 + j * ulp * 2};
      EXPECT_EQ(orientation(a, b, c), (c[1] > c[0]) - (c[1] < c[0])) << i << ' ' << j;
    }
  }
}

TEST(StaticPredicates, OrientationOfHugeAndTinyCoordinates) {
  EXPECT_EQ(orientation(Point2{-1e308, -1e308}, {1e308, 1e308}, {1e-308, 1e-308}), 0);
  EXPECT_EQ(orientation(Point2{-1e308, -1e308}, {1e308, 1e308}, {1e-308, 2e-308}), 1);
  EXPECT_EQ(orientation(Point3{-1e308, 0, 0}, {1e308, 0, 1e-308}, {0, 1e308, 0}, {0, -1e308, 1e-308}), 0);
  EXPECT_EQ(orientation(Point3{-1e308, 0, 0}, {1e308, 0, 1e-308}, {0, 1e308, 0}, {0, -1e308, 2e-308}), 1);
}

}  // namespace
}  // namespace noli
