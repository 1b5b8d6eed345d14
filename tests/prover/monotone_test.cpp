// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/monotone.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.h"

namespace noli::testing {
namespace {

constexpr LaidFace unit_face = {{0, 1, 2}, {1, 0, 0, 1}, true};

NearVertex near(const Position& x_t0, const Position& x_t1, float radius = 0) {
  NearVertex v{};
  for (std::size_t k = 0; k < 3; ++k) {
    v.x_t0[k] = static_cast<float>(x_t0[k]);
    v.x_t1[k] = static_cast<float>(x_t1[k]);
    v.radius[k] = radius;
  }
  return v;
}

/// The tangents of a face whose corners move between two sets of positions.
TangentBox box_of(const LaidFace& face, const std::array<Position, 3>& from, const std::array<Position, 3>& to,
                  float radius = 0) {
  return tangents_of(face, near(from[0], to[0], radius), near(from[1], to[1], radius), near(from[2], to[2], radius));
}

constexpr std::array<Position, 3> flat = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};

TEST(Monotone, InversesAreKnownOrNotUsed) {
  const LaidFace face = laid_face({4, 5, 6}, {0.5, 0.5}, {0.75, 0.5}, {0.5, 0.625});
  EXPECT_TRUE(face.usable);
  EXPECT_EQ(face.m, (std::array<float, 4>{4, 0, 0, 8}));
  EXPECT_EQ(face.vertices, (std::array<VertexId, 3>{4, 5, 6}));
  EXPECT_FALSE(laid_face({0, 1, 2}, {0, 0}, {1, 1}, {0.5, 0.5}).usable);
  EXPECT_FALSE(laid_face({0, 1, 2}, {0, 0}, {1, 1}, {0.5, 0.5 + 0x1p-40}).usable);
  EXPECT_FALSE(laid_face({0, 1, 2}, {0, 0}, {1e-40, 0}, {0, 1e-40}).usable);
  EXPECT_TRUE(laid_face({0, 1, 2}, {0, 0}, {0, 1}, {1, 0}).usable);  // the other way round
}

TEST(Monotone, AFlatFaceIsAndAFoldIsNot) {
  const TangentBox box = box_of(unit_face, flat, flat);
  EXPECT_TRUE(is_monotone(box, 3));
  EXPECT_TRUE(is_monotone(box, 2));
  const std::array<Position, 3> back = {{{0, 0, 0}, {-1, 0, 0.1}, {0, 1, 0}}};
  const TangentBox other = box_of(unit_face, back, back);
  EXPECT_TRUE(is_monotone(other, 3));
  EXPECT_FALSE(is_monotone(merged(box, other), 3));
  EXPECT_FALSE(is_monotone(box_of(unit_face, flat, back), 3));
}

TEST(Monotone, TheRestOfTheBoxCounts) {
  EXPECT_TRUE(is_monotone(box_of(unit_face, flat, flat, 0.05F), 3));
  EXPECT_FALSE(is_monotone(box_of(unit_face, flat, flat, 0.5F), 3));
  const std::array<Position, 3> steep = {{{0, 0, 0}, {0.5, 0, 0.8}, {0, 1, 0}}};
  EXPECT_TRUE(is_monotone(merged(box_of(unit_face, flat, flat), box_of(unit_face, steep, steep)), 3));
}

/// Each of two faces may be monotone, but a path along one and then along the other may return.
TEST(Monotone, WhatMixesTheAxesCounts) {
  TangentBox box = empty_tangents();
  for (const float shear : {0.9F, 3.0F}) {
    box.low_u = Lanes{1, -shear, 0, 0};
    box.high_u = Lanes{1, shear, 0, 0};
    box.low_v = Lanes{-shear, 1, 0, 0};
    box.high_v = Lanes{shear, 1, 0, 0};
    EXPECT_EQ(is_monotone(box, 2), shear < 1);
  }
}

TEST(Monotone, WhatIsNotKnownIsNot) {
  const LaidFace unusable = {{0, 1, 2}, {1, 0, 0, 1}, false};
  EXPECT_FALSE(is_monotone(box_of(unusable, flat, flat), 3));
  EXPECT_FALSE(is_monotone(merged(box_of(unusable, flat, flat), box_of(unit_face, flat, flat)), 3));
  EXPECT_FALSE(is_monotone(empty_tangents(), 3));
  const std::array<Position, 3> point = {};
  EXPECT_FALSE(is_monotone(box_of(unit_face, point, point), 3));
  NearVertex lost{};
  lost.radius = lanes(0x1p100F);
  for (int place = 0; place < 3; ++place) {
    std::array<NearVertex, 3> v = {near(flat[0], flat[0]), near(flat[1], flat[1]), near(flat[2], flat[2])};
    v[static_cast<std::size_t>(place)] = lost;
    const TangentBox box = tangents_of(unit_face, v[0], v[1], v[2]);
    EXPECT_FALSE(is_monotone(box, 3));
    EXPECT_FALSE(is_monotone(merged(box, box_of(unit_face, flat, flat)), 3));
  }
}

/// The box contains the tangents for all positions within the radii and all times. They are computed in double, which
/// is far more precise than the box.
TEST(Monotone, TheBoxHoldsTheTangents) {
  Random random(9);
  for (int i = 0; i < 3000; ++i) {
    const auto place = [&] { return Point2{random.unit(), random.unit()}; };
    const Point2 a = place(), b = place(), c = place();
    const LaidFace face = laid_face({0, 1, 2}, a, b, c);
    if (!face.usable) continue;
    std::array<NearVertex, 3> v;
    std::array<Position, 3> x;
    const double s = 0.5 + 0.5 * random.unit();
    const float radius = random.below(2) == 0 ? 0 : static_cast<float>(std::abs(random.unit()));
    for (std::size_t j = 0; j < 3; ++j) {
      const Position from = {random.unit(), random.unit(), random.unit()};
      const Position to = {random.unit(), random.unit(), random.unit()};
      v[j] = near(from, to, radius);
      for (std::size_t k = 0; k < 3; ++k) {
        x[j][k] = (1 - s) * static_cast<double>(v[j].x_t0[k]) + s * static_cast<double>(v[j].x_t1[k]) +
                  (random.below(2) == 0 ? radius : -radius);
      }
    }
    const TangentBox box = tangents_of(face, v[0], v[1], v[2]);
    const double r00 = b[0] - a[0], r01 = c[0] - a[0], r10 = b[1] - a[1], r11 = c[1] - a[1];
    const double area = r00 * r11 - r01 * r10;
    for (std::size_t k = 0; k < 3; ++k) {
      const double e1 = x[1][k] - x[0][k], e2 = x[2][k] - x[0][k];
      const double u = (e1 * r11 - e2 * r10) / area, w = (e2 * r00 - e1 * r01) / area;
      EXPECT_LE(box.low_u[k], u);
      EXPECT_GE(box.high_u[k], u);
      EXPECT_LE(box.low_v[k], w);
      EXPECT_GE(box.high_v[k], w);
    }
  }
}

/// Along a direction d of the layout, faces move by d_u f_u + d_v f_v. These vectors form a box on one side of a plane
/// through 0, so it does not contain 0.
TEST(Monotone, NoDirectionOfTheLayoutIsLost) {
  Random random(10);
  int yes = 0, no = 0;
  for (int i = 0; i < 3000; ++i) {
    TangentBox box = empty_tangents();
    for (std::size_t k = 0; k < 3; ++k) {
      const double u = random.unit(), v = random.unit();
      const auto wide = [&] { return random.below(3) == 0 ? 1 + random.unit() : 0.1; };
      const double wide_u = wide(), wide_v = wide();
      box.low_u[k] = static_cast<float>(u - wide_u);
      box.high_u[k] = static_cast<float>(u + wide_u);
      box.low_v[k] = static_cast<float>(v - wide_v);
      box.high_v[k] = static_cast<float>(v + wide_v);
    }
    const bool monotone = is_monotone(box, 3);
    (monotone ? yes : no) += 1;
    for (int j = 0; monotone && j < 50; ++j) {
      const double du = random.unit(), dv = random.unit();
      bool zero_inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const double u0 = du * box.low_u[k], u1 = du * box.high_u[k];
        const double v0 = dv * box.low_v[k], v1 = dv * box.high_v[k];
        zero_inside =
            zero_inside && std::min(u0, u1) + std::min(v0, v1) <= 0 && std::max(u0, u1) + std::max(v0, v1) >= 0;
      }
      EXPECT_FALSE(zero_inside);
    }
  }
  EXPECT_GT(yes, 100);
  EXPECT_GT(no, 100);
}

}  // namespace
}  // namespace noli::testing
