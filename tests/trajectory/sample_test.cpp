// SPDX-License-Identifier: Apache-2.0
#include "trajectory/sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support.h"

namespace noli {
namespace {

constexpr double largest = std::numeric_limits<double>::max();

WorldLines line(const std::vector<double>& times, const std::vector<Position>& positions) {
  return WorldLines::from_breakpoints({0, times.size()}, times, positions, "line");
}

TEST(Sample, IsExactAtBreakpoints) {
  const WorldLines lines = line({0, 0.1, 0.3}, {{0.1, -0.0, 3}, {0.7, 1e300, -1}, {0.2, 5, 6}});
  EXPECT_EQ(testing::bits(sample(lines, 0)), testing::bits({{0.1, -0.0, 3}}));
  EXPECT_EQ(testing::bits(sample(lines, 0.1)), testing::bits({{0.7, 1e300, -1}}));
  EXPECT_EQ(testing::bits(sample(lines, 0.3)), testing::bits({{0.2, 5, 6}}));
}

TEST(Sample, IsLinearBetweenThem) {
  const WorldLines lines = line({0, 1, 3}, {{0, 0, 8}, {4, -4, 8}, {0, 0, 8}});
  EXPECT_EQ(sample(lines, 0.25), (std::vector<Position>{{1, -1, 8}}));
  EXPECT_EQ(sample(lines, 1.5), (std::vector<Position>{{3, -3, 8}}));
}

TEST(Sample, EachVertexHasTimesOfItsOwn) {
  const WorldLines lines = WorldLines::from_breakpoints({0, 2, 5}, {0, 2, 0, 0.5, 2},
                                                        {{0, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 4, 0}}, "l");
  EXPECT_EQ(sample(lines, 1), (std::vector<Position>{{1, 0, 0}, {0, 2, 0}}));
}

TEST(Sample, StaysBetweenTheBreakpointsWhateverTheyAre) {
  const Position a{largest, 1e-320, -largest}, b{-largest, 3e-320, -largest};
  for (const auto& [begin, end] : {std::pair(0.0, 1.0), std::pair(-largest, largest), std::pair(0.0, 5e-324 * 16)}) {
    const WorldLines lines = line({begin, end}, {a, b});
    for (int i = 0; i <= 16; ++i) {
      const double t = begin + (end / 16 - begin / 16) * i;
      if (t > end) continue;
      const Position x = sample(lines, t).front();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_GE(x[axis], std::min(a[axis], b[axis]));
        EXPECT_LE(x[axis], std::max(a[axis], b[axis]));
      }
    }
  }
}

TEST(Sample, IsNearTheLongDoubleValue) {
  std::mt19937_64 random(3);
  const auto real = [&random] { return static_cast<double>(random() % 100001) / 1000 - 50; };
  for (int i = 0; i < 1000; ++i) {
    const double begin = real(), end = begin + 1 + std::abs(real());
    const double t = begin + (end - begin) * static_cast<double>(random() % 1001) / 1001;
    const double a = real(), b = real();
    const long double exact = a + (static_cast<long double>(t) - begin) / (static_cast<long double>(end) - begin) *
                                      (static_cast<long double>(b) - a);
    EXPECT_NEAR(sample(line({begin, end}, {{a, 0, 0}, {b, 0, 0}}), t)[0][0], static_cast<double>(exact), 1e-13);
  }
}

}  // namespace
}  // namespace noli
