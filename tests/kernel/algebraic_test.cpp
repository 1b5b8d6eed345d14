// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/arithmetic/algebraic.h"
#include "tests/kernel/polynomials.h"
#include "tests/kernel/random_numbers.h"

namespace noli {
namespace {

using test::polynomial;
using test::Random;

/// den t - num
Polynomial factor(long num, long den) { return polynomial({-num, den}); }

Polynomial random_polynomial(Random& random, int degree, int reach) {
  std::vector<long> c(static_cast<std::size_t>(degree + 1));
  for (long& x : c) x = random.around_zero(reach);
  c.back() = 1 + random.below(reach);
  return polynomial(c);
}

int sign(std::strong_ordering order) { return order < 0 ? -1 : order > 0; }

// --- integers and dyadic numbers

TEST(Dyadic, KeepsDoubles) {
  for (const double x : {0.0, 1.0, -1.5, 0x1p-1074, -0x1.8p-1073, 0x1.fffffffffffffp1023, 1.0 / 3, 0x1p-1022}) {
    EXPECT_EQ(floor_to_double(Dyadic::from_double(x)), x);
    EXPECT_EQ(ceil_to_double(Dyadic::from_double(x)), x);
  }
}

TEST(Dyadic, RoundsBothWays) {
  const auto middle_above = [](double x) {
    return middle(Dyadic::from_double(x), Dyadic::from_double(std::nextafter(x, INFINITY)));
  };
  for (const double x : {1.0, 0x1p-1074, 0.0, 1.0 / 3, 0x1p-1022, -1.0, -0x1p-1074, 1e300}) {
    EXPECT_EQ(floor_to_double(middle_above(x)), x);
    EXPECT_EQ(ceil_to_double(middle_above(x)), std::nextafter(x, INFINITY));
  }
  const Dyadic huge{Integer(1) << 1024, 0};
  EXPECT_EQ(floor_to_double(huge), 0x1.fffffffffffffp1023);
  EXPECT_EQ(ceil_to_double(huge), INFINITY);
}

TEST(Dyadic, Compares) {
  EXPECT_TRUE(Dyadic::from_double(0.5) == (Dyadic{Integer(4), 3}));
  EXPECT_TRUE(Dyadic::from_double(0.5) < (Dyadic{Integer(5), 3}));
  EXPECT_TRUE(Dyadic::from_double(0.5) > (Dyadic{Integer(-5), 0}));
}

// --- polynomials

TEST(Polynomials, FormsAreHomogeneous) {
  // s^2 + 3 s t + 5 t^2 at s = 1 - t: 1 + t + 3 t^2
  EXPECT_EQ(from_form({Integer(1), Integer(3), Integer(5)}), polynomial({1, 1, 3}));
  EXPECT_TRUE(from_form({Integer(0), Integer(0)}).is_zero());
  EXPECT_EQ(from_form({Integer(1), Integer(2), Integer(1)}).degree(), 0);  // (s + t)^2 = 1
}

TEST(Polynomials, GcdOfProducts) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Polynomial common = random_polynomial(random, 1 + random.below(3), 9).primitive();
    const Polynomial a = random_polynomial(random, 1 + random.below(3), 9), b = random_polynomial(random, 2, 9);
    const Polynomial g = gcd(common * a, common * b);
    EXPECT_FALSE(surely_coprime(common * a, common * b));
    EXPECT_EQ(quotient(g, common).degree(), gcd(a, b).degree());
    EXPECT_EQ((quotient(g, common) * common).primitive(), g);
    if (surely_coprime(a, b)) {
      EXPECT_EQ(g, common);
    }
  }
  EXPECT_TRUE(surely_coprime(polynomial({1, 2}), polynomial({1, 3})));
}

TEST(Polynomials, SquareFreePart) {
  const Polynomial p = factor(1, 3), q = polynomial({-1, 0, 2});
  EXPECT_EQ(square_free_part(p * p * p * q).primitive(), (p * q).primitive());
  EXPECT_EQ(square_free_part(q), q);
}

TEST(Polynomials, SignsAtRationals) {
  const Polynomial p = polynomial({-1, 0, 2});  // zero at the root of 1/2
  EXPECT_EQ(p.sign_at(Dyadic::from_double(0.7)), -1);
  EXPECT_EQ(p.sign_at(Dyadic::from_double(0.75)), 1);
  EXPECT_EQ(p.sign_at_rational(Integer(2), Integer(3)), -1);
  EXPECT_EQ(p.sign_at_rational(Integer(5), Integer(7)), 1);
  EXPECT_EQ(factor(5, 7).sign_at_rational(Integer(5), Integer(7)), 0);
}

// --- roots

/// Multiplies known rational factors, some repeated, and one without a root. All roots must be found, in order, each
/// once.
TEST(Roots, KnownRationalRootsAreFound) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    Polynomial p = random.below(2) == 0 ? polynomial({3}) : polynomial({1, -1, 1});
    std::vector<double> expected;
    for (int k = 1 + random.below(4); k > 0; --k) {
      const long den = 1 + random.below(16), num = random.around_zero(static_cast<int>(den) + 3);
      p = p * factor(num, den);
      if (num >= 0 && num <= den) expected.push_back(static_cast<double>(num) / static_cast<double>(den));
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    const auto roots = roots_in_unit_interval(p);
    ASSERT_EQ(roots.size(), expected.size());
    for (std::size_t k = 0; k < roots.size(); ++k) {
      ASSERT_NEAR(roots[k].floor(), expected[k], 0x1p-53);
      ASSERT_EQ(roots[k].sign_of(p), 0);
    }
  }
}

TEST(Roots, CloseRootsAreTakenApart) {
  // (N t - k)(N t - k - 1) + 1 has no root; with - 1 / N^2 instead, two within about 2^-60 of k / N and (k + 1) / N.
  const long big = 1000000007;
  const Polynomial p = factor(333333333, big) * factor(333333334, big);
  EXPECT_EQ(roots_in_unit_interval(p).size(), 2u);
  EXPECT_EQ(roots_in_unit_interval(p + polynomial({1})).size(), 0u);
  Polynomial scaled = p * polynomial({big}) * polynomial({big});
  scaled -= polynomial({1});
  EXPECT_EQ(roots_in_unit_interval(scaled).size(), 2u);
}

/// Compares with sign changes on a fine grid. They are a lower bound for the number of roots and have its parity.
TEST(Roots, NoneIsMissedByAGrid) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Polynomial p = random_polynomial(random, 1 + random.below(6), 50);
    const auto roots = roots_in_unit_interval(p);
    ASSERT_LE(static_cast<int>(roots.size()), p.degree());
    for (int k = 0; k < 64; ++k) {
      const Dyadic a{Integer(k), 6}, b{Integer(k + 1), 6};
      const auto inside = std::count_if(roots.begin(), roots.end(),
                                        [&](const AlgebraicNumber& r) { return r.compare(a) > 0 && r.compare(b) < 0; });
      const int change = p.sign_at(a) * p.sign_at(b);
      const bool simple = surely_coprime(p, p.derivative());
      if (change < 0) {
        ASSERT_GE(inside, 1);
      }
      if (change != 0 && simple) {
        ASSERT_EQ(inside % 2 == 1, change < 0);
      }
    }
  }
}

// --- numbers

TEST(AlgebraicNumbers, RefineWithoutEnd) {
  AlgebraicNumber root = roots_in_unit_interval(polynomial({-1, 0, 2})).at(0);
  root.refine(5000);
  EXPECT_TRUE(root.low() < root.high());
  const std::size_t e = std::max(root.low().e, root.high().e);
  EXPECT_LE(root.high().scaled(e) - root.low().scaled(e), Integer(1) << (e - 5000));
  EXPECT_EQ(root.polynomial().sign_at(root.low()) * root.polynomial().sign_at(root.high()), -1);
}

TEST(AlgebraicNumbers, EqualNumbersFromDifferentPolynomials) {
  const Polynomial p = polynomial({-1, 0, 2});
  const auto a = roots_in_unit_interval(p).at(0);
  const auto b = roots_in_unit_interval(p * polynomial({-1, 0, 0, 5})).at(1);
  EXPECT_EQ(sign(a <=> b), 0);
  EXPECT_EQ(a.sign_of(p * polynomial({7, 1})), 0);
  EXPECT_EQ(a.sign_of(polynomial({-1, 0, 0, 5})), 1);
  EXPECT_EQ(
      sign(AlgebraicNumber::rational(Integer(2), Integer(6)) <=> AlgebraicNumber::rational(Integer(1), Integer(3))), 0);
  EXPECT_EQ(sign(AlgebraicNumber::rational(Integer(1), Integer(2)) <=> AlgebraicNumber(Dyadic::from_double(0.5))), 0);
}

TEST(AlgebraicNumbers, NearlyEqualNumbersAreTold) {
  // The roots of 2 t^2 - 1 and 2 N t^2 - N - 1 differ by about 1 / (3 N).
  for (const std::size_t bits : {40u, 60u, 200u, 3000u}) {
    const Polynomial n({std::vector<Integer>{Integer(1) << bits}});
    const auto a = roots_in_unit_interval(polynomial({-1, 0, 2})).at(0);
    const auto b = roots_in_unit_interval(polynomial({-1, 0, 2}) * n - polynomial({1})).at(0);
    EXPECT_EQ(sign(a <=> b), -1);
    EXPECT_EQ(sign(b <=> a), 1);
    EXPECT_EQ(a.sign_of(b.polynomial()), -1);
    EXPECT_EQ(b.sign_of(a.polynomial()), 1);
  }
}

/// Signs and comparisons agree: the number of roots of p later than t decides the sign of p at t.
TEST(AlgebraicNumbers, SignsFollowFromTheOrderOfRoots) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Polynomial p = random_polynomial(random, 1 + random.below(4), 6),
                     q = random_polynomial(random, 1 + random.below(4), 6);
    const auto roots_p = roots_in_unit_interval(p);
    for (const auto& t : roots_in_unit_interval(q)) {
      bool equal = false;
      for (const auto& r : roots_p) equal |= (t <=> r) == 0;
      ASSERT_EQ(t.sign_of(p) == 0, equal);
      if (equal || !surely_coprime(p, p.derivative())) continue;
      const auto later = std::count_if(roots_p.begin(), roots_p.end(), [&](const auto& r) { return r > t; });
      const int at_one = p.sign_at(Dyadic::from_integer(1));
      if (at_one != 0) {
        ASSERT_EQ(t.sign_of(p), later % 2 == 0 ? at_one : -at_one);
      }
    }
  }
}

/// Tests floor() by its definition, also for tiny roots.
TEST(AlgebraicNumbers, FloorIsTheLargestDoubleBelow) {
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    Polynomial p = random_polynomial(random, 1 + random.below(5), 40);
    if (random.below(8) == 0) p = p * polynomial({-1, 1000}) * polynomial({-1, 0, 1L << 62});
    for (const auto& t : roots_in_unit_interval(p)) {
      const double below = t.floor();
      ASSERT_GE(t.compare(Dyadic::from_double(below)), 0);
      ASSERT_LT(t.compare(Dyadic::from_double(std::nextafter(below, 2.0))), 0);
    }
  }
}

TEST(AlgebraicNumbers, FloorOfNumbersBelowAllDoubles) {
  const std::vector<Integer> tiny = {Integer(-1), Integer(0), Integer(1) << 5000};
  EXPECT_EQ(roots_in_unit_interval(Polynomial(tiny)).at(0).floor(), 0);
  const std::vector<Integer> subnormal = {Integer(-3), Integer(1) << 1074};
  EXPECT_EQ(roots_in_unit_interval(Polynomial(subnormal)).at(0).floor(), 3 * 0x1p-1074);
  const std::vector<Integer> between = {Integer(-10), Integer(3) << 1074};
  EXPECT_EQ(roots_in_unit_interval(Polynomial(between)).at(0).floor(), 3 * 0x1p-1074);
}

}  // namespace
}  // namespace noli
