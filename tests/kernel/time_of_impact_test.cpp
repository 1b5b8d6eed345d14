// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <mpfr.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <noli/cgal.h>
#include <noli/time_of_impact.h>
#include "kernel/arithmetic/algebraic.h"
#include "tests/kernel/polynomials.h"
#include "tests/kernel/random_numbers.h"

namespace noli {
namespace {

using test::polynomial;
using test::Random;

/// The square root of 1/2.
TimeOfImpact root_of_half() { return TimeOfImpact(roots_in_unit_interval(polynomial({-1, 0, 2})).at(0)); }

class Mpfr {
 public:
  explicit Mpfr(mpfr_prec_t precision) { mpfr_init2(value_, precision); }
  Mpfr(const Mpfr&) = delete;
  Mpfr& operator=(const Mpfr&) = delete;
  ~Mpfr() { mpfr_clear(value_); }
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

constexpr std::array roundings = {MPFR_RNDN, MPFR_RNDZ, MPFR_RNDU, MPFR_RNDD, MPFR_RNDA};

TEST(TimeOfImpact, DefaultIsZero) {
  EXPECT_EQ(TimeOfImpact().lower(), 0);
  EXPECT_EQ(TimeOfImpact().upper(), 0);
  EXPECT_EQ(TimeOfImpact(), TimeOfImpact::from_double(0));
}

TEST(TimeOfImpact, DoublesOnBothSides) {
  const TimeOfImpact t = root_of_half();
  EXPECT_EQ(t.lower(), 0x1.6a09e667f3bccp-1);
  EXPECT_EQ(t.upper(), 0x1.6a09e667f3bcdp-1);
  EXPECT_LT(TimeOfImpact::from_double(t.lower()), t);
  EXPECT_GT(TimeOfImpact::from_double(t.upper()), t);
}

TEST(TimeOfImpact, DoublesAreThemselves) {
  for (const double t : {0.0, 1.0, 0.5, 0x1p-1074, 0x1.fffffffffffffp-1, 1.0 / 3, 0x1.8p-1050}) {
    EXPECT_EQ(TimeOfImpact::from_double(t).lower(), t);
    EXPECT_EQ(TimeOfImpact::from_double(t).upper(), t);
  }
}

TEST(TimeOfImpact, OnlyInTheStep) {
  EXPECT_THROW(TimeOfImpact::from_double(-0x1p-1074), std::domain_error);
  EXPECT_THROW(TimeOfImpact::from_double(std::nextafter(1.0, 2.0)), std::domain_error);
  EXPECT_THROW(TimeOfImpact::from_double(NAN), std::domain_error);
  EXPECT_THROW(TimeOfImpact::from_rational(1, 0), std::domain_error);
  EXPECT_THROW(TimeOfImpact::from_rational(4, 3), std::domain_error);
  EXPECT_THROW(TimeOfImpact::from_rational(-1, 3), std::domain_error);
  EXPECT_EQ(TimeOfImpact::from_rational(-1, -2), TimeOfImpact::from_double(0.5));
}

TEST(TimeOfImpact, RationalsCompareAsFractions) {
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const long b = 1 + random.below(60), d = 1 + random.below(60);
    const long a = random.below(static_cast<int>(b) + 1), c = random.below(static_cast<int>(d) + 1);
    const auto x = TimeOfImpact::from_rational(a, b);
    const auto y = TimeOfImpact::from_rational(c, d);
    ASSERT_EQ(x <=> y, a * d <=> c * b) << a << '/' << b << ' ' << c << '/' << d;
    ASSERT_EQ(x == y, a * d == c * b);
  }
}

TEST(TimeOfImpact, EnclosuresShrink) {
  const TimeOfImpact t = root_of_half();
  AlgebraicNumber finer = t.algebraic();
  finer.refine(300);
  const Dyadic low = finer.low(), high = finer.high();
  EXPECT_LT(low, high);
  EXPECT_LE(middle(low, low), high);
  const std::size_t e = std::max(low.e, high.e);
  EXPECT_LE(high.scaled(e) - low.scaled(e), Integer(1) << (e - 300));
  EXPECT_TRUE(TimeOfImpact::from_double(0.25).algebraic().is_dyadic());
}

TEST(TimeOfImpact, PolynomialIsPrimitive) {
  const TimeOfImpact t(roots_in_unit_interval(polynomial({6, 0, -12})).at(0));
  EXPECT_EQ(t.algebraic().polynomial().primitive(), polynomial({-1, 0, 2}));
  EXPECT_EQ(TimeOfImpact::from_rational(4, 6).algebraic().polynomial().primitive(), polynomial({-2, 3}));
}

/// Compares with MPFR's own square root, for all roundings and many precisions.
TEST(TimeOfImpact, MpfrIsCorrectlyRounded) {
  for (const mpfr_prec_t precision : {2, 3, 24, 53, 64, 113, 500, 4000}) {
    for (const mpfr_rnd_t rounding : roundings) {
      Mpfr expected(precision), actual(precision), half(precision);
      mpfr_set_d(half.get(), 0.5, MPFR_RNDN);
      const int ternary = mpfr_sqrt(expected.get(), half.get(), rounding);
      const int answer = to_mpfr(root_of_half(), actual.get(), rounding);
      EXPECT_TRUE(mpfr_equal_p(expected.get(), actual.get())) << precision;
      EXPECT_EQ(answer > 0, ternary > 0) << precision;
      EXPECT_EQ(answer < 0, ternary < 0) << precision;
    }
  }
}

/// Numbers that need every bit, and ties: the root is dyadic, but the polynomial does not reveal it.
TEST(TimeOfImpact, MpfrOfHiddenDyadicNumbers) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const int bits = 2 + random.below(70);
    Integer m = (Integer(1) << static_cast<std::size_t>(bits)) - Integer(1 + 2 * random.below(2));
    const Dyadic x{m, static_cast<std::size_t>(bits)};
    const Polynomial hidden = Polynomial({-x.m, Integer(1) << x.e}) * polynomial({-1, 0, 0, 0, 0, 3});
    for (const auto& root : roots_in_unit_interval(hidden)) {
      if (root.sign_of(polynomial({-1, 0, 0, 0, 0, 3})) == 0) continue;
      for (const mpfr_rnd_t rounding : roundings) {
        const mpfr_prec_t precision = 2 + random.below(72);
        Mpfr expected(precision), actual(precision);
        const int ternary = mpfr_set_z_2exp(expected.get(), x.m.get(), -bits, rounding);
        const int answer = to_mpfr(TimeOfImpact(root), actual.get(), rounding);
        ASSERT_TRUE(mpfr_equal_p(expected.get(), actual.get()));
        ASSERT_EQ((answer > 0) - (answer < 0), (ternary > 0) - (ternary < 0));
      }
    }
  }
}

/// lower() must equal MPFR's rounding down to 53 bits.
TEST(TimeOfImpact, LowerIsMpfrRoundedDown) {
  Random random(3);
  int seen = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<long> c(4);
    for (long& x : c) x = random.around_zero(1000);
    if (c[3] == 0) continue;
    for (const auto& root : roots_in_unit_interval(polynomial(c))) {
      Mpfr down(53);
      const TimeOfImpact t(root);
      to_mpfr(t, down.get(), MPFR_RNDD);
      ASSERT_EQ(t.lower(), mpfr_get_d(down.get(), MPFR_RNDD));
      ++seen;
    }
  }
  EXPECT_GT(seen, 500);
}

/// Tests lower() by its definition, with signs evaluated here. Roots of even multiplicity, and two roots between
/// neighbouring doubles, show no change of sign; those few are tested with compare().
TEST(SlowTimeOfImpact, LowerOfAMillionRoots) {
  Random random(4);
  int seen = 0, shown_by_signs = 0;
  while (seen < 1000000) {
    std::vector<long> c;
    for (int k = 1 + random.below(4); k >= 0; --k)
      c.push_back(static_cast<long>(random.bits() >> (20 + random.below(40))));
    c[static_cast<std::size_t>(random.below(static_cast<int>(c.size())))] *= -1;
    c.push_back(1 + random.below(1000000));
    const Polynomial p = polynomial(c);
    for (const auto& root : roots_in_unit_interval(p)) {
      const double lower = TimeOfImpact(root).lower();
      const Dyadic below = Dyadic::from_double(lower), above = Dyadic::from_double(std::nextafter(lower, 2.0));
      const bool shown = p.sign_at(below) == 0 || p.sign_at(below) * p.sign_at(above) < 0;
      ASSERT_TRUE(shown || (root.compare(below) >= 0 && root.compare(above) < 0));
      shown_by_signs += shown;
      ++seen;
    }
  }
  EXPECT_GT(shown_by_signs, seen / 100 * 99);
}

}  // namespace
}  // namespace noli
