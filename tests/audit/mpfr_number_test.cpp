// SPDX-License-Identifier: Apache-2.0
//
// Compares MPFR's numbers with the processor's: with 53 bits and IEEE 754 exponents they agree, bit for bit.
#include "audit/numerics/mpfr_number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "audit/fuzz/random.h"
#include "audit/numerics/replay.h"

namespace noli::audit {
namespace {

constexpr double least = std::numeric_limits<double>::denorm_min(), greatest = std::numeric_limits<double>::max(),
                 smallest_normal = std::numeric_limits<double>::min(),
                 infinity = std::numeric_limits<double>::infinity();

/// Counts the kinds of results of a comparison, so that a test can require every kind.
struct Seen {
  std::uint64_t operations = 0, different = 0, subnormal = 0, infinite = 0, zero = 0, not_a_number = 0;

  void add(double expected, const MpfrNumber& found) {
    ++operations;
    if (!same_bits(expected, found)) ++different;
    if (std::isnan(expected)) ++not_a_number;
    if (std::isinf(expected)) ++infinite;
    if (expected == 0) ++zero;
    if (std::fpclassify(expected) == FP_SUBNORMAL) ++subnormal;
  }
};

void compare(double x, double y, Seen& seen) {
  const MpfrNumber a(x), b(y);
  seen.add(x + y, a + b);
  seen.add(x - y, a - b);
  seen.add(x * y, a * b);
  seen.add(x / y, a / b);
  seen.add(std::sqrt(x), sqrt(a));
  seen.add(-x, -a);
  seen.add(std::abs(y), abs(b));
}

/// Pairs of operands: random bits, exponents near each other, or products and quotients that become subnormal or
/// overflow.
std::pair<double, double> pair_of(Random& random) {
  const double x = std::bit_cast<double>(random.next()), y = std::bit_cast<double>(random.next());
  if (random.one_in(4)) return {x, y};
  const auto significand = [](double z) {
    int exponent = 0;
    const double part = std::frexp(z, &exponent);
    return std::isfinite(part) ? part : 0.75;
  };
  const double a = significand(x), b = significand(y);
  const int e = static_cast<int>(random.between(-1074, 1023));
  switch (random.below(4)) {
    case 0: return {std::ldexp(a, e), std::ldexp(b, e + static_cast<int>(random.between(-60, 60)))};
    case 1: return {std::ldexp(a, e), std::ldexp(b, static_cast<int>(random.between(-1080, -1015)) - e)};
    case 2: return {std::ldexp(a, e), std::ldexp(b, e - static_cast<int>(random.between(-1080, -1015)))};
    default: return {std::ldexp(a, e), std::ldexp(b, static_cast<int>(random.between(1015, 1030)) - e)};
  }
}

Seen compare_pairs(std::uint64_t count, std::uint64_t seed) {
  Random random(seed);
  Seen seen;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto [x, y] = pair_of(random);
    compare(x, y, seen);
  }
  return seen;
}

void expect_all_sorts(const Seen& seen) {
  EXPECT_EQ(seen.different, 0U);
  for (const std::uint64_t count : {seen.subnormal, seen.infinite, seen.zero, seen.not_a_number}) {
    EXPECT_GT(count, seen.operations / 1000);
  }
}

TEST(MpfrNumber, IsTheProcessorsDouble) {
  const MpfrScope scope(hardware_double);
  expect_all_sorts(compare_pairs(1'000'000, 1));
}

TEST(MpfrNumber, IsTheProcessorsDoubleSlow) {
  const MpfrScope scope(hardware_double);
  expect_all_sorts(compare_pairs(20'000'000, 2));
}

TEST(MpfrNumber, IsNotTheProcessorsDoubleWithAnyOtherArithmetic) {
  for (const Arithmetic& other : {Arithmetic{52, true}, Arithmetic{54, true}, Arithmetic{53, false}}) {
    const MpfrScope scope(other);
    EXPECT_GT(compare_pairs(10'000, 3).different, 100U) << other.bits;
  }
}

TEST(MpfrNumber, IsTheProcessorsDoubleAtTheBorders) {
  const MpfrScope scope(hardware_double);
  const std::array<double, 18> all = {0.0,
                                      -0.0,
                                      1.0,
                                      -1.5,
                                      least,
                                      -least,
                                      3 * least,
                                      greatest,
                                      -greatest,
                                      infinity,
                                      -infinity,
                                      smallest_normal,
                                      0x1p-537,
                                      0x1p512,
                                      std::nextafter(smallest_normal, 0.0),
                                      0x1p-1022 + 0x1p-1074,
                                      1 + 0x1p-52,
                                      std::numeric_limits<double>::quiet_NaN()};
  Seen seen;
  for (const double x : all) {
    for (const double y : all) compare(x, y, seen);
  }
  expect_all_sorts(seen);
}

TEST(MpfrNumber, RoundsSubnormalNumbersOnce) {
  const MpfrScope scope(hardware_double);
  // The product is (2.5 + 2^-53 - 2^-103) times the least subnormal. Rounded to 53 bits first it would be 2.5, a tie,
  // and then round down.
  const double a = std::ldexp(1 + 0x1p-52, -537), b = std::ldexp(2.5 - 0x1p-51, -537);
  EXPECT_EQ(a * b, 3 * least);
  EXPECT_EQ(static_cast<double>(MpfrNumber(a) * MpfrNumber(b)), 3 * least);
  EXPECT_EQ(static_cast<double>(MpfrNumber(2.5) * MpfrNumber(least)), 2 * least);
  EXPECT_EQ(static_cast<double>(MpfrNumber(least) / MpfrNumber(2.0)), 0.0);
  EXPECT_EQ(static_cast<double>(MpfrNumber(3 * least) / MpfrNumber(2.0)), 2 * least);
}

TEST(MpfrNumber, OverflowsWhereDoubleDoes) {
  const MpfrScope scope(hardware_double);
  const MpfrNumber most(greatest);
  EXPECT_EQ(static_cast<double>(most + MpfrNumber(0x1p969)), greatest);
  EXPECT_FALSE((most + MpfrNumber(0x1p970)).finite());
  EXPECT_FALSE((most * MpfrNumber(2.0)).finite());
  const MpfrScope wide({53, false});
  EXPECT_TRUE((most * MpfrNumber(2.0)).finite());
}

TEST(MpfrNumber, HasThePrecisionOfItsScope) {
  for (const int bits : {2, 24, 52, 53, 64, 65, 113, 128, 256, 1000, 1024}) {
    const MpfrScope scope({bits, false});
    MpfrNumber last(1.0);  // becomes 2^-(p-1), the last place of 1
    for (int i = 1; i < bits; ++i) last = last / MpfrNumber(2.0);
    const MpfrNumber one(1.0), half = last / MpfrNumber(2.0);
    EXPECT_EQ(one.bits(), bits);
    EXPECT_FALSE(one + last == one) << bits;
    EXPECT_TRUE(one + half == one) << bits;                         // a tie, down to even
    EXPECT_TRUE((one + last) + half == one + last + last) << bits;  // a tie, up to even
    const MpfrNumber third = one / MpfrNumber(3.0), error = abs(third * MpfrNumber(3.0) - one);
    EXPECT_TRUE(error <= last) << bits;
  }
}

TEST(MpfrNumber, IsCopiedExactlyBetweenPrecisions) {
  const MpfrScope outer({256, false});
  const MpfrNumber third = MpfrNumber(1.0) / MpfrNumber(3.0);
  {
    const MpfrScope inner(hardware_double);
    const MpfrNumber copy = third;  // NOLINT(performance-unnecessary-copy-initialization): it is what is tested
    MpfrNumber assigned;
    assigned = third;
    EXPECT_TRUE(copy == third && assigned == third);
    EXPECT_EQ(copy.bits(), 256);
    EXPECT_EQ((copy * MpfrNumber(1.0)).bits(), 53);
    EXPECT_FALSE(copy * MpfrNumber(1.0) == third);
    EXPECT_EQ(static_cast<double>(copy), 1.0 / 3);
  }
  EXPECT_EQ(MpfrNumber(1.0).bits(), 256);
  MpfrNumber itself(third);
  const MpfrNumber& same = itself;
  itself = same;
  EXPECT_TRUE(itself == third);
}

TEST(MpfrNumber, ScopesGiveBackWhatTheyFound) {
  const mpfr_exp_t low = mpfr_get_emin(), high = mpfr_get_emax();
  {
    const MpfrScope scope(hardware_double);
    EXPECT_EQ(mpfr_get_emin(), -1073);
    EXPECT_EQ(mpfr_get_emax(), 1024);
  }
  EXPECT_EQ(mpfr_get_emin(), low);
  EXPECT_EQ(mpfr_get_emax(), high);
  EXPECT_THROW(MpfrScope({1, false}), std::invalid_argument);
  EXPECT_THROW(MpfrScope({1025, false}), std::invalid_argument);
}

TEST(MpfrNumber, ComparesAsDoublesDo) {
  const MpfrScope scope(hardware_double);
  const std::array<double, 7> all = {
      -infinity, -1.0, -0.0, 0.0, 2.0, infinity, std::numeric_limits<double>::quiet_NaN()};
  for (const double x : all) {
    for (const double y : all) {
      const MpfrNumber a(x), b(y);
      EXPECT_EQ(a == b, x == y);
      EXPECT_EQ(a != b, x != y);
      EXPECT_EQ(a < b, x < y);
      EXPECT_EQ(a <= b, x <= y);
      EXPECT_EQ(a > b, x > y);
      EXPECT_EQ(a >= b, x >= y);
    }
  }
}

TEST(MpfrNumber, SameBitsSeesSignsOfZero) {
  const MpfrScope scope(hardware_double);
  EXPECT_TRUE(same_bits(-0.0, MpfrNumber(-0.0)));
  EXPECT_FALSE(same_bits(0.0, MpfrNumber(-0.0)));
  EXPECT_FALSE(same_bits(1.0, MpfrNumber(std::nextafter(1.0, 2.0))));
  EXPECT_FALSE(same_bits(std::numeric_limits<double>::quiet_NaN(), MpfrNumber(1.0)));
  EXPECT_TRUE(same_bits(std::numeric_limits<double>::quiet_NaN(), MpfrNumber(0.0) / MpfrNumber(0.0)));
}

/// The order of adding three terms must be the one that Eigen uses for doubles.
TEST(MpfrNumber, IsAddedUpInTheOrderOfDoubles) {
  const MpfrScope scope(hardware_double);
  Random random(5);
  for (int i = 0; i < 10'000; ++i) {
    integrator::Vec<double, 3> x, y;
    for (int k = 0; k < 3; ++k) {
      x[k] = std::ldexp(random.unit() - 0.5, static_cast<int>(random.between(-20, 20)));
      y[k] = random.unit() - 0.5;
    }
    const auto a = precise(x), b = precise(y);
    ASSERT_TRUE(same_bits(x.dot(y), a.dot(b)));
    ASSERT_TRUE(same_bits(x.squaredNorm(), a.squaredNorm()));
    const integrator::Vec<double, 3> cross = x.cross(y), quotient = x / y[0];
    const integrator::Vec<MpfrNumber, 3> big_cross = a.cross(b), big_quotient = a / b[0];
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(same_bits(cross[k], big_cross[k]));
      ASSERT_TRUE(same_bits(quotient[k], big_quotient[k]));
    }
  }
}

}  // namespace
}  // namespace noli::audit
