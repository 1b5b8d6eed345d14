// SPDX-License-Identifier: Apache-2.0
#include "certificates/closest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

namespace noli::certificates {
namespace {

using V3 = Vector<3>;
using V2 = Vector<2>;

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

V3 point(std::mt19937_64& random) { return {2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1}; }

/// All barycentric weights of a feature of n vertices in steps of 1 / fine.
std::vector<std::array<double, 3>> mixtures(std::size_t n, int fine) {
  std::vector<std::array<double, 3>> result;
  for (int i = 0; i <= fine; ++i) {
    for (int j = 0; j <= fine - i; ++j) {
      const double a = static_cast<double>(i) / fine, b = static_cast<double>(j) / fine;
      if (n == 1 && i + j > 0) continue;
      if (n == 2 && j > 0) continue;
      result.push_back({1 - a - b, a, b});
    }
  }
  return result;
}

/// The least distance over a lattice of points of both features.
double least_distance(FeaturePair kind, const std::array<V3, 4>& x, int fine) {
  const std::size_t first = first_size(kind), size = point_count(kind);
  double least = 1e300;
  for (const auto& a : mixtures(first, fine)) {
    for (const auto& b : mixtures(size - first, fine)) {
      V3 r = V3::Zero();
      for (std::size_t i = 0; i < first; ++i) r += a[i] * x[i];
      for (std::size_t i = first; i < size; ++i) r -= b[i - first] * x[i];
      least = std::min(least, r.norm());
    }
  }
  return least;
}

class ClosestPoints : public testing::TestWithParam<FeaturePair> {};

INSTANTIATE_TEST_SUITE_P(Kinds, ClosestPoints, testing::ValuesIn(all_feature_pairs));

TEST_P(ClosestPoints, AreAsNearAsAnyPoints) {
  constexpr int fine = 24;
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    std::array<V3, 4> x;
    for (V3& p : x) p = point(random);
    if (i % 4 == 1) x[3] = x[2];                      // degenerate
    if (i % 4 == 2) x[3] = x[2] + 2 * (x[1] - x[0]);  // parallel edges
    const std::size_t size = point_count(GetParam());
    const auto c = closest<3>(GetParam(), std::span<const V3>(x.data(), size));
    double of_a = 0, of_b = 0;
    V3 r = V3::Zero();
    for (std::size_t k = 0; k < size; ++k) {
      (k < first_size(GetParam()) ? of_a : of_b) += c.weights[k];
      EXPECT_TRUE(k < first_size(GetParam()) ? c.weights[k] >= 0 : c.weights[k] <= 0);
      r += c.weights[k] * x[k];
    }
    EXPECT_NEAR(of_a, 1, 1e-15);
    EXPECT_NEAR(of_b, -1, 1e-15);
    EXPECT_LT((r - c.r).norm(), 1e-15);
    const double lattice = least_distance(GetParam(), x, fine);
    EXPECT_LE(c.distance(), lattice + 1e-12) << i;
    EXPECT_GE(c.distance(), lattice - 4.0 / fine) << i;
  }
}

TEST(Closest, TheGradientOfTheDistanceIsItsWeightsTimesTheDirection) {
  std::mt19937_64 random(2);
  for (const FeaturePair kind : all_feature_pairs) {
    for (int i = 0; i < 50; ++i) {
      std::array<V3, 4> x;
      for (V3& p : x) p = point(random);
      const std::size_t size = point_count(kind);
      const auto d = [&] { return closest<3>(kind, std::span<const V3>(x.data(), size)).distance(); };
      const auto c = closest<3>(kind, std::span<const V3>(x.data(), size));
      if (c.distance() < 0.05) continue;
      for (std::size_t k = 0; k < size; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
          constexpr double h = 1e-6;
          const double kept = x[k][axis];
          x[k][axis] = kept + h;
          const double above = d();
          x[k][axis] = kept - h;
          const double below = d();
          x[k][axis] = kept;
          EXPECT_NEAR((above - below) / (2 * h), c.weights[k] * c.r[axis] / c.distance(), 1e-4);
        }
      }
    }
  }
}

/// Above faces so thin that their barycentric products cancel.
TEST(Closest, AVertexAboveASliverIsAsFarAsItIsHigh) {
  std::mt19937_64 random(3);
  for (int exponent = 2; exponent <= 14; ++exponent) {
    const double half = std::pow(10, -exponent);
    for (const double apex : {-1.0, 0.2, 1.0}) {
      for (int i = 0; i < 100; ++i) {
        const V3 above(1.8 * unit(random) - 0.9, -0.95 * half, 0.03);
        std::array<V3, 4> x{above, V3(-1, -half, 0), V3(1, -half, 0), V3(apex, half, 0)};
        std::rotate(x.begin() + 1, x.begin() + 1 + i % 3, x.end());
        EXPECT_NEAR(closest<3>(FeaturePair::vertex_face, std::span<const V3>(x)).distance(), 0.03, 1e-9) << exponent;
      }
    }
  }
}

TEST(Closest, ParallelEdgesMeetInTheMiddleOfTheirOverlap) {
  const std::array<V3, 4> x = {V3(0, 0, 0), V3(4, 0, 0), V3(1, 1, 0), V3(3, 1, 0)};
  const auto c = closest<3>(FeaturePair::edge_edge, std::span<const V3>(x));
  EXPECT_DOUBLE_EQ(c.distance(), 1);
  EXPECT_DOUBLE_EQ(c.weights[1], 0.5);
  EXPECT_DOUBLE_EQ(c.weights[3], -0.5);
  EXPECT_EQ(c.slide_count, 1U);
}

TEST(Closest, CornersHoldWhatInteriorsLetSlide) {
  const std::array<V3, 4> over = {V3(0.2, 0.2, 1), V3(0, 0, 0), V3(1, 0, 0), V3(0, 1, 0)};
  EXPECT_EQ(closest<3>(FeaturePair::vertex_face, std::span<const V3>(over)).slide_count, 2U);
  const std::array<V3, 4> beside = {V3(0.2, -1, 1), V3(0, 0, 0), V3(1, 0, 0), V3(0, 1, 0)};
  EXPECT_EQ(closest<3>(FeaturePair::vertex_face, std::span<const V3>(beside)).slide_count, 1U);
  const std::array<V3, 4> corner = {V3(-1, -1, 1), V3(0, 0, 0), V3(1, 0, 0), V3(0, 1, 0)};
  EXPECT_EQ(closest<3>(FeaturePair::vertex_face, std::span<const V3>(corner)).slide_count, 0U);
}

TEST(Closest, WorksInThePlane) {
  const std::array<V2, 3> x = {V2(0.5, 2), V2(0, 0), V2(1, 0)};
  const auto c = closest<2>(FeaturePair::vertex_edge, std::span<const V2>(x));
  EXPECT_DOUBLE_EQ(c.distance(), 2);
  EXPECT_DOUBLE_EQ(c.weights[1], -0.5);
}

}  // namespace
}  // namespace noli::certificates
