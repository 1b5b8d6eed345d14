// SPDX-License-Identifier: Apache-2.0
//
// Tests in rational arithmetic that world lines stay within the radius of their chords.
#include "proofs/prover/windows/chord.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"
#include "window_scenes.h"

namespace noli::testing {
namespace {

using Rational = mpq_class;

/// The exact position of the world line at a time.
Rational place_at(const WorldLine& line, double time, std::size_t k) {
  const std::size_t i = line.segment_after(time);
  const Rational t0 = line.t[i], t1 = line.t[i + 1], x0 = line.x[i][k], x1 = line.x[i + 1][k];
  return x0 + (Rational(time) - t0) / (t1 - t0) * (x1 - x0);
}

struct Deviation {
  Rational most = 0;      ///< largest distance of the line from the chord
  Rational least_radius;  ///< half the width of the strip along the straight line between the ends
};

/// The deviation at both ends of [begin, end] and at all breakpoints in it; in between it is linear.
Deviation deviation(const WorldLine& line, const Chord<3>& chord, double begin, double end, std::size_t k) {
  Deviation result;
  Rational low = 0, high = 0;
  const Rational b = begin, e = end, from = place_at(line, begin, k), to = place_at(line, end, k);
  const auto look = [&](double time) {
    const Rational s = (Rational(time) - b) / (e - b), x = place_at(line, time, k);
    const Rational away = x - ((1 - s) * chord.x_t0[k] + s * chord.x_t1[k]), off = x - ((1 - s) * from + s * to);
    result.most = std::max<Rational>(result.most, abs(away));
    low = std::min(low, off);
    high = std::max(high, off);
  };
  look(begin);
  look(end);
  for (const double t : line.t) {
    if (begin < t && t < end) look(t);
  }
  result.least_radius = (high - low) / 2;
  return result;
}

struct Shape {
  const char* name;
  double time, place, offset;
};
constexpr Shape shapes[] = {{"usual", 1, 1, 0},          {"far", 1, 1, 1e12},
                            {"tiny", 1e-290, 1e-300, 0}, {"subnormal", 1e-300, 0x1p-1070, 0},
                            {"huge", 1e290, 1e307, 0},   {"wide_time", 1e305, 1, 0}};

class ChordOf : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Chords, ChordOf, ::testing::ValuesIn(shapes),
                         [](const auto& s) { return std::string(s.param.name); });

LineScene random_line(Random& random, const Shape& shape) {
  std::vector<Breakpoint> path;
  double t = shape.time * random.unit();
  const std::uint32_t count = 2 + random.below(7);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto coordinate = [&] { return shape.offset + shape.place * random.unit(); };
    path.push_back({t, {coordinate(), coordinate(), coordinate()}});
    t += shape.time * (0.01 + std::abs(random.unit()));
  }
  LineScene scene;
  scene.vertex(path);
  return scene;
}

TEST_P(ChordOf, IsNoFartherThanItsRadius) {
  Random random(3);
  int between = 0, whole = 0;
  for (int i = 0; i < 2000; ++i) {
    const LineScene scene = random_line(random, GetParam());
    const WorldLines lines = scene.lines();
    const WorldLine line(lines, 0);
    const auto some_time = [&] {
      const double a = line.t.front(), b = line.t.back(), s = 0.5 + 0.5 * random.unit();
      return random.below(3) == 0 ? std::clamp(a + s * (b - a), a, b)
                                  : line.t[random.below(static_cast<std::uint32_t>(line.t.size()))];
    };
    const double p = some_time(), q = some_time();
    if (p == q) continue;
    const double begin = std::min(p, q), end = std::max(p, q);
    const Chord<3> chord = chord_of<3>(line, begin, end);
    std::size_t inside = 0;
    for (const double t : line.t) inside += begin < t && t < end ? 1 : 0;
    EXPECT_EQ(chord.inside, inside);
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_TRUE(std::isfinite(chord.radius[k]));
      const Deviation exact = deviation(line, chord, begin, end, k);
      ASSERT_LE(exact.most, Rational(chord.radius[k]));
      // The radius is hardly larger than necessary: by at most 2^-43 of the scale.
      const Rational scale = Rational(GetParam().place) + GetParam().offset;
      ASSERT_LE(Rational(chord.radius[k]), exact.least_radius + scale / (1L << 43) + Rational(0x1p-1020));
    }
    (inside > 0 ? between : whole) += 1;
  }
  EXPECT_GT(between, 100);
  EXPECT_GT(whole, 100);
}

TEST(Chord, OfOneSegmentIsTheSegment) {
  LineScene scene;
  scene.vertex({{0, {1, 2, 3}}, {1, {5, 0.1, 1e300}}, {3, {0, 0, 0}}});
  const WorldLines lines = scene.lines();
  const Chord<3> chord = chord_of<3>(WorldLine(lines, 0), 0, 1);
  EXPECT_EQ(chord.x_t0, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(chord.x_t1, (std::array<double, 3>{5, 0.1, 1e300}));
  EXPECT_EQ(chord.radius, (std::array<double, 3>{}));
  EXPECT_EQ(chord.inside, 0u);
}

TEST(Chord, GoesThroughTheMiddleOfTheStrip) {
  LineScene scene;
  scene.vertex({{0, {0, 0, 0}}, {1, {2, 0, 1}}, {2, {0, 0, -1}}, {3, {0, 0, 0}}});
  const WorldLines lines = scene.lines();
  const Chord<3> chord = chord_of<3>(WorldLine(lines, 0), 0, 3);
  EXPECT_EQ(chord.x_t0[0], 1);
  EXPECT_EQ(chord.x_t1[0], 1);
  EXPECT_NEAR(chord.radius[0], 1, 1e-12);
  EXPECT_EQ(chord.x_t0[2], 0);
  EXPECT_NEAR(chord.radius[2], 1, 1e-12);
  EXPECT_LT(chord.radius[1], 1e-300);
}

TEST(Chord, WhatOverflowsHasAnInfiniteRadius) {
  constexpr double most = std::numeric_limits<double>::max(), infinity = std::numeric_limits<double>::infinity();
  LineScene scene;
  scene.vertex({{0, {-most, 0, 0}}, {1, {0, 1, 0}}, {2, {most, 0, 0}}});
  const WorldLines lines = scene.lines();
  const Chord<3> far = chord_of<3>(WorldLine(lines, 0), 0, 2);
  EXPECT_EQ(far.radius[0], infinity);
  EXPECT_LT(far.radius[1], 1);
  const Chord<3> half = chord_of<3>(WorldLine(lines, 0), 0.5, 1.5);
  EXPECT_TRUE(half.radius[0] == infinity || half.radius[0] < most);

  LineScene longest;
  longest.vertex({{-most, {0, 0, 0}}, {0, {1, 1, 1}}, {most, {0, 0, 0}}});
  const WorldLines long_lines = longest.lines();
  EXPECT_EQ(chord_of<3>(WorldLine(long_lines, 0), -most, most).radius[0], infinity);
  LineScene shortest;
  shortest.vertex({{0, {0, 0, 0}}, {0x1p-1074, {1, 1, 1}}, {0x1p-1073, {0, 0, 0}}});
  const WorldLines short_lines = shortest.lines();
  EXPECT_EQ(chord_of<3>(WorldLine(short_lines, 0), 0, 0x1p-1073).radius[0], infinity);
}

}  // namespace
}  // namespace noli::testing
