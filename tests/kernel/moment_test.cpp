// SPDX-License-Identifier: Apache-2.0
#include "kernel/moment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/kernel/polynomials.h"
#include "tests/kernel/random_numbers.h"

namespace noli {
namespace {

using test::polynomial;
using test::Random;

TimeOfImpact third() { return TimeOfImpact::from_rational(1, 3); }

/// The square root of 1/2.
TimeOfImpact root_of_half() { return TimeOfImpact(roots_in_unit_interval(polynomial({-1, 0, 2})).at(0)); }

TEST(Moment, InTheUnitWindowIsTheTimeOfImpact) {
  const Window window{0, 1};
  for (const TimeOfImpact& s : {third(), root_of_half(), TimeOfImpact(), TimeOfImpact::from_double(1)}) {
    const Moment t(window, 0, 1, s);
    EXPECT_EQ(t.lower(), s.lower());
    EXPECT_EQ(t.upper(), s.upper());
  }
}

TEST(Moment, DoublesOnBothSides) {
  const Moment t({10, 16}, 10, 16, third());
  EXPECT_EQ(t.lower(), 12);
  EXPECT_EQ(t.upper(), 12);
  EXPECT_EQ(t.compare(12), 0);
  EXPECT_LT(t.compare(12.5), 0);
  EXPECT_GT(t.compare(11.5), 0);
  const Moment r({10, 16}, 12, 14, root_of_half());  // 12 + sqrt 2
  EXPECT_EQ(r.upper(), std::nextafter(r.lower(), 100));
  EXPECT_GT(r.compare(r.lower()), 0);
  EXPECT_LT(r.compare(r.upper()), 0);
  EXPECT_NEAR(r.lower(), 12 + std::sqrt(2.0), 1e-14);
}

TEST(Moment, TheEndsOfAPieceAreThemselves) {
  const Window window{-0.1, 0.7};
  EXPECT_EQ(Moment(window, 0.1, 0.3, TimeOfImpact()).lower(), 0.1);
  EXPECT_EQ(Moment(window, 0.1, 0.3, TimeOfImpact()).upper(), 0.1);
  EXPECT_EQ(Moment(window, 0.1, 0.3, TimeOfImpact::from_double(1)).lower(), 0.3);
  EXPECT_EQ(Moment(window, 0.1, 0.3, TimeOfImpact::from_double(1)).upper(), 0.3);
}

TEST(Moment, DifferentPiecesCompare) {
  const Window window{1, 4};
  const Moment one(window, 1, 4, third()), two(window, 1, 3, TimeOfImpact::from_double(0.5));
  EXPECT_EQ(one, two);  // both 2
  const Moment a(window, 1, 3, root_of_half()), b(window, 1, 4, root_of_half());
  EXPECT_LT(a, b);
  EXPECT_GT(b, a);
  // 1 + sqrt 2 as a time of two pieces: sqrt(1/2) of [1, 3], and the root of 9 s^2 = 2 of [1, 4].
  const TimeOfImpact other(roots_in_unit_interval(polynomial({-2, 0, 9})).at(0));
  EXPECT_EQ(a, Moment(window, 1, 4, other));
}

TEST(Moment, TimesOfAnySizeAreRight) {
  constexpr double most = std::numeric_limits<double>::max(), least = 0x1p-1074;
  EXPECT_EQ(Moment({-most, most}, -most, most, TimeOfImpact::from_double(0.5)).lower(), 0);
  EXPECT_EQ(Moment({-most, most}, -most, most, TimeOfImpact::from_double(0.75)).lower(), most / 2);
  const Moment tiny({0, least}, 0, least, third());
  EXPECT_EQ(tiny.lower(), 0);
  EXPECT_EQ(tiny.upper(), least);
  const Moment early({0, 1e300}, 0, 0x1p-1000, third());
  EXPECT_NEAR(early.lower() * 0x1p1000, 1.0 / 3, 1e-15);
  EXPECT_EQ(std::nextafter(early.lower(), 1), early.upper());
  const double next = std::nextafter(1e16, 2e16);  // doubles are two apart there
  const Moment coarse({1e16, next}, 1e16, next, third());
  EXPECT_EQ(coarse.lower(), 1e16);
  EXPECT_EQ(coarse.upper(), next);
}

/// A moment compares correctly with the doubles that enclose it, and with other times of impact in the same piece.
TEST(Moment, OrderIsThatOfTheTimes) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const double from = random.unit() - 0.5, to = from + random.unit() + 0x1p-40;
    const Window window{-1, 2};
    const auto draw = [&] { return TimeOfImpact::from_rational(random.below(30), 30); };
    const TimeOfImpact s = draw(), r = draw();
    const Moment a(window, from, to, s), b(window, from, to, r);
    EXPECT_EQ(a <=> b, s <=> r);
    EXPECT_GE(a.compare(a.lower()), 0);
    EXPECT_LE(a.compare(a.upper()), 0);
    EXPECT_LT(a.compare(std::nextafter(a.upper(), 10)), 0);
    EXPECT_GT(a.compare(std::nextafter(a.lower(), -10)), 0);
    EXPECT_LE(a.upper(), std::nextafter(a.lower(), 10));
  }
}

}  // namespace
}  // namespace noli
