// SPDX-License-Identifier: Apache-2.0
#include "kernel/failure_time.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/kernel/random_numbers.h"
#include "tests/kernel/rational_motion.h"

namespace noli {
namespace {

using test::coordinate;
using test::holds;
using test::Random;
constexpr double infinity = std::numeric_limits<double>::infinity();

// --- replay over the rationals

template <int Dim, class A, class B>
bool fails_at(const A& a, const B& b, const Point<Dim>& n, double g, const mpq_class& t) {
  mpq_class sum = -mpq_class(g);
  for (std::size_t i = 0; i < Dim; ++i) sum += mpq_class(n[i]) * (coordinate<Dim>(a, i, t) - coordinate<Dim>(b, i, t));
  return sum <= 0;
}

/// Checks the definition: no failure before the answer, and no earlier answer than rounding down requires. The margin
/// is linear, so the ends of an interval decide for all of it.
template <int Dim, class A, class B>
void check(const A& a, const B& b, const Point<Dim>& n, double g, double from) {
  const double t = failure_time(a, b, n, g, from);
  ASSERT_GE(t, from);
  const auto fails = [&](const mpq_class& at) { return fails_at<Dim>(a, b, n, g, at); };
  if (fails(mpq_class(from))) {
    ASSERT_EQ(t, from);
  } else if (t == infinity) {
    mpq_class far(1);
    mpz_ui_pow_ui(far.get_num_mpz_t(), 2, 12000);
    ASSERT_FALSE(fails(far)) << "late";
  } else {
    const mpq_class at(t), just_before = at - (at - mpq_class(from)) / mpq_class(1e30);
    ASSERT_FALSE(t > from && fails(just_before)) << "late";
    const double next = std::nextafter(t, infinity);
    ASSERT_TRUE(next == infinity || fails(mpq_class(next))) << "earlier than need be";
  }
}

struct Numbers {
  Random& random;
  int mode;

  double value() {
    const double sign = random.below(2) == 0 ? 1 : -1;
    switch (mode) {
      case 0: return random.around_zero(3);
      case 1: return sign * random.unit();
      case 2: return sign * std::ldexp(random.unit(), random.around_zero(300));
      default: return random.below(3) == 0 ? 0.0 : sign * std::ldexp(1 + random.unit(), random.around_zero(1000));
    }
  }
  template <int Dim>
  Point<Dim> point() {
    Point<Dim> p;
    for (double& x : p) x = value();
    return p;
  }
  template <int Dim>
  Ray<Dim> ray() {
    return {value(), point<Dim>(), point<Dim>()};
  }
  template <int Dim>
  MotionSegment<Dim> chord() {
    double t0 = value(), t1 = value();
    if (t0 > t1) std::swap(t0, t1);
    if (t0 == t1) t1 = std::nextafter(t1, infinity);
    return {t0, point<Dim>(), t1, point<Dim>()};
  }
};

template <int Dim>
void check_random(std::uint64_t seed, int count) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    Numbers numbers{random, i % 4};
    const auto n = numbers.point<Dim>();
    const double g = numbers.value(), from = numbers.value();
    ASSERT_NO_FATAL_FAILURE(check<Dim>(numbers.ray<Dim>(), numbers.ray<Dim>(), n, g, from));
    ASSERT_NO_FATAL_FAILURE(check<Dim>(numbers.chord<Dim>(), numbers.ray<Dim>(), n, g, from));
    ASSERT_NO_FATAL_FAILURE(check<Dim>(numbers.ray<Dim>(), numbers.chord<Dim>(), n, g, from));
    ASSERT_NO_FATAL_FAILURE(check<Dim>(numbers.chord<Dim>(), numbers.chord<Dim>(), n, g, from));
  }
}

TEST(FailureTime, ExactReplayInThePlane) { check_random<2>(1, 4000); }
TEST(FailureTime, ExactReplayInSpace) { check_random<3>(2, 4000); }

TEST(SlowFailureTime, MillionExactReplays) {
  check_random<2>(3, 125000);
  check_random<3>(4, 125000);
}

const Ray<3> still{0, {0, 0, 0}, {0, 0, 0}};

TEST(FailureTime, RoundsDown) {
  const Ray<3> falling{0, {1, 0, 0}, {-3, 0, 0}};
  EXPECT_EQ(failure_time(falling, still, Point3{1, 0, 0}, 0, 0), 0x1.5555555555555p-2);
  const Ray<3> later{0, {5, 0, 0}, {-3, 0, 0}};
  EXPECT_EQ(failure_time(later, still, Point3{1, 0, 0}, 0, 0),
            0x1.aaaaaaaaaaaaap0);  // the double nearest to 5/3 is too late
}

TEST(FailureTime, FailedAlready) {
  const Ray<3> at_gap{0, {1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(failure_time(at_gap, still, Point3{1, 0, 0}, 1, 0), 0);
  EXPECT_EQ(failure_time(at_gap, still, Point3{1, 0, 0}, 2, 0.5), 0.5);
}

TEST(FailureTime, Never) {
  const Ray<3> parallel{0, {1, 0, 0}, {0, 5, 0}}, leaving{0, {1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(failure_time(parallel, still, Point3{1, 0, 0}, 0, 0), infinity);
  EXPECT_EQ(failure_time(leaving, still, Point3{1, 0, 0}, 0, 0), infinity);
}

TEST(FailureTime, LaterThanAllDoublesIsTheLargest) {
  const Ray<3> slow{0, {1e300, 0, 0}, {-1e-300, 0, 0}};
  EXPECT_EQ(failure_time(slow, still, Point3{1, 0, 0}, 0, 0), std::numeric_limits<double>::max());
}

TEST(FailureTime, ChordsMeetWhereTheyWereRecorded) {
  const MotionSegment<3> down{1, {1, 0, 0}, 2, {-1, 0, 0}}, up{0, {-2, 0, 0}, 4, {2, 0, 0}};
  EXPECT_EQ(failure_time(down, up, Point3{1, 0, 0}, 0, 1), 0x1.aaaaaaaaaaaaap0);
}

// --- walls and balls, over the rationals

template <int Dim, class Certificate>
void check(const Ray<Dim>& p, const Certificate& certificate, double from, double later) {
  const auto exactly = [&](double at) { return holds<Dim>(p, certificate, mpq_class(at)); };
  ASSERT_EQ(holds_at(p, certificate, from), exactly(from));
  ASSERT_EQ(holds_until(p, certificate, from, later), exactly(from) && exactly(later));
  const double end = failure_time(p, certificate, from);
  if (!exactly(from)) {
    ASSERT_EQ(end, from);
  } else if (end == infinity) {
    ASSERT_TRUE(exactly(std::numeric_limits<double>::max())) << "late";
  } else {
    ASSERT_TRUE(exactly(end)) << "late";
    const double next = std::nextafter(end, infinity);
    ASSERT_TRUE(next == infinity || !exactly(next)) << "earlier than need be";
    // Decisions are hardest at the end itself.
    ASSERT_TRUE(holds_until(p, certificate, from, end));
    ASSERT_TRUE(next == infinity || !holds_until(p, certificate, from, next));
  }
}

template <int Dim>
void check_walls_and_balls(std::uint64_t seed, int count) {
  Random random(seed);
  int ended = 0, inside = 0;
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    Numbers numbers{random, i % 4};
    const Ray<Dim> p = numbers.ray<Dim>();
    double from = numbers.value(), later = numbers.value();
    if (later < from) std::swap(from, later);
    const MovingWall<Dim> wall{numbers.point<Dim>(), numbers.value(),           numbers.value(),
                               numbers.value(),      std::abs(numbers.value()), random.below(2) == 0};
    ASSERT_NO_FATAL_FAILURE(check<Dim>(p, wall, from, later));
    MovingBall<Dim> ball{numbers.ray<Dim>(), std::abs(numbers.value())};
    if (random.below(2) == 0) {  // close to it
      ball.centre = p;
      for (double& v : ball.centre.v) v += numbers.value();
    }
    ASSERT_NO_FATAL_FAILURE(check<Dim>(p, ball, from, later));
    inside += holds_at(p, ball, from) ? 1 : 0;
    ended += failure_time(p, wall, from) < infinity ? 1 : 0;
  }
  EXPECT_GT(inside, count / 20);
  EXPECT_LT(inside, count - count / 20);
  EXPECT_GT(ended, count / 10);
}

TEST(FailureTime, WallsAndBallsInThePlane) { check_walls_and_balls<2>(5, 4000); }
TEST(FailureTime, WallsAndBallsInSpace) { check_walls_and_balls<3>(6, 4000); }
TEST(SlowFailureTime, WallsAndBallsManyTimes) {
  check_walls_and_balls<2>(7, 125000);
  check_walls_and_balls<3>(8, 125000);
}

TEST(FailureTime, OfAWallThatIsReached) {
  const Ray<3> falling{0, {1, 0, 0}, {-3, 0, 0}};
  const MovingWall<3> floor{{1, 0, 0}, 0, 0, 0, 0, true};
  EXPECT_EQ(failure_time(falling, floor, 0), 0x1.5555555555555p-2);
  EXPECT_TRUE(holds_until(falling, floor, 0, 0x1.5555555555555p-2));
  EXPECT_FALSE(holds_until(falling, floor, 0, 0x1.5555555555556p-2));
  const MovingWall<3> runs_ahead{{1, 0, 0}, 0, -3, 0, 0.5, true};
  EXPECT_EQ(failure_time(falling, runs_ahead, 0), infinity);
  const MovingWall<3> ceiling{{1, 0, 0}, 1, 0, 0, 0, false};
  EXPECT_EQ(failure_time(falling, ceiling, 0), infinity) << "it begins on it, and leaves";
}

TEST(FailureTime, OfABallThatIsLeft) {
  const MovingBall<2> unit{{0, {0, 0}, {0, 0}}, 1};
  EXPECT_EQ(failure_time(Ray<2>{0, {0, 0}, {0.6, 0.8}}, unit, 0), 0.99999999999999988898) << "0.6 and 0.8 are rounded";
  EXPECT_EQ(failure_time(Ray<2>{0, {-1, 0}, {1, 0}}, unit, 0), 2);
  EXPECT_EQ(failure_time(Ray<2>{0, {-1, 0}, {0, 1}}, unit, 0), 0) << "along the border from a point on it";
  EXPECT_EQ(failure_time(Ray<2>{0, {0.5, 0}, {0, 0}}, unit, 0), infinity);
  EXPECT_EQ(failure_time(Ray<2>{0, {2, 0}, {-1, 0}}, unit, 0.5), 0.5) << "it is not inside yet";
}

}  // namespace
}  // namespace noli
