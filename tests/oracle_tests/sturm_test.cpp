// SPDX-License-Identifier: Apache-2.0
#include "oracle/sturm.h"

#include <gtest/gtest.h>

#include "oracle/time.h"

namespace noli::oracle {
namespace {

Polynomial polynomial(std::vector<Integer> c) { return Polynomial(std::move(c)); }

/// den t - num.
Polynomial root_at(long num, long den) { return polynomial({Integer(-num), Integer(den)}); }

TEST(Polynomials, AddMultiplyAndCancel) {
  const Polynomial p = polynomial({1, 2, 3}), q = polynomial({0, 1});
  EXPECT_EQ(p + q, polynomial({1, 3, 3}));
  EXPECT_EQ(p * q, polynomial({0, 1, 2, 3}));
  EXPECT_TRUE((p - p).is_zero());
  EXPECT_EQ((p - p).degree(), -1);
  EXPECT_EQ(polynomial({6, -9}).primitive(), polynomial({2, -3}));
}

TEST(Polynomials, RemainderIsAPositiveMultiple) {
  // t^2 + 1 = (t + 1)(t - 1) + 2, with divisors of either sign.
  EXPECT_GT(sgn(remainder(polynomial({1, 0, 1}), polynomial({-1, 1}))[0]), 0);
  EXPECT_GT(sgn(remainder(polynomial({1, 0, 1}), polynomial({3, -3}))[0]), 0);
  EXPECT_LT(sgn(remainder(polynomial({-1, 0, -1}), polynomial({3, -3}))[0]), 0);
  EXPECT_TRUE(remainder(polynomial({-1, 0, 1}), polynomial({-7, 7})).is_zero());
}

TEST(Polynomials, QuotientHasTheSignOfTheTrueOne) {
  EXPECT_EQ(exact_quotient(polynomial({-1, 0, 1}), polynomial({-1, 1})), polynomial({1, 1}));
  EXPECT_EQ(exact_quotient(polynomial({-1, 0, 1}), polynomial({5, -5})), polynomial({-1, -1}));
}

TEST(Polynomials, SignAtADyadicAndOnAnInterval) {
  const Polynomial p = root_at(3, 8);
  EXPECT_EQ(p.sign_at({3, 3}), 0);
  EXPECT_EQ(p.sign_at({1, 2}), -1);
  EXPECT_EQ(p.sign_at({1, 1}), 1);
  EXPECT_EQ(sign_throughout(p, {3, 2}, {1, 0}), 1);
  EXPECT_EQ(sign_throughout(p, {1, 3}, {1, 2}), -1);
  EXPECT_EQ(sign_throughout(p, {1, 2}, {1, 1}), 0);
}

TEST(Sturm, FindsEveryRootOfTheUnitIntervalOnce) {
  EXPECT_EQ(Time::roots_of(root_at(0, 1) * root_at(1, 1) * root_at(1, 2)).size(), 3U);
  EXPECT_EQ(Time::roots_of(root_at(-1, 2) * root_at(3, 2)).size(), 0U);
  EXPECT_EQ(Time::roots_of(polynomial({1, 0, 1})).size(), 0U);
  EXPECT_EQ(Time::roots_of(root_at(1, 3) * root_at(1, 3) * root_at(2, 3)).size(), 2U);
  EXPECT_EQ(Time::roots_of(polynomial({5})).size(), 0U);
  // Two roots 2^-40 apart, and one next to 0.
  EXPECT_EQ(Time::roots_of(root_at(1, 3) * polynomial({-(Integer(1) << 40) - 3, 3 * (Integer(1) << 40)})).size(), 2U);
  EXPECT_EQ(Time::roots_of(root_at(0, 1) * polynomial({-1, Integer(1) << 200})).size(), 2U);
}

TEST(Sturm, TarskiQueryGivesAllThreeSigns) {
  const Polynomial p = polynomial({-1, 0, 2});  // the root 0.7071...
  const IsolatedRoot root = roots_in_unit_interval(p).at(0);
  EXPECT_EQ(sign_at_root(root_at(7, 10), p, root), 1);
  EXPECT_EQ(sign_at_root(root_at(71, 100), p, root), -1);
  EXPECT_EQ(sign_at_root(p * root_at(1, 5), p, root), 0);
  EXPECT_EQ(sign_at_root(polynomial({-3}), p, root), -1);
}

TEST(Times, SignsAtAndAfterARoot) {
  const Polynomial half_squared = polynomial({-1, 0, 2});
  const Time t = Time::roots_of(half_squared).at(0);
  EXPECT_EQ(t.sign_of(half_squared), 0);
  EXPECT_EQ(t.sign_after(half_squared), 1);
  EXPECT_EQ(t.sign_after(half_squared * root_at(4, 5)), -1);
  EXPECT_EQ(t.sign_after(half_squared * half_squared), 1);
  EXPECT_EQ(t.sign_after(Polynomial()), 0);
  EXPECT_TRUE(t.changes_sign(half_squared));
  EXPECT_FALSE(t.changes_sign(half_squared * half_squared));
  EXPECT_TRUE(t.changes_sign(half_squared * half_squared * half_squared));
  EXPECT_FALSE(t.changes_sign(root_at(1, 2)));
  EXPECT_FALSE(t.changes_sign(Polynomial()));
  // So close that no bound on the interval decides; the Sturm sequence must.
  const Polynomial near = polynomial({-(Integer(1) << 200), 0, 2 * (Integer(1) << 200) + 1});
  EXPECT_EQ(t.sign_of(near), 1);
}

TEST(Times, Compare) {
  const Time root = Time::roots_of(polynomial({-1, 0, 2})).at(0), third = Time::roots_of(root_at(1, 3)).at(0);
  const Time same = Time::roots_of(polynomial({-1, 0, 2}) * root_at(1, 7)).at(1);
  EXPECT_EQ(root.compare(same), 0);
  EXPECT_EQ(root.compare(third), 1);
  EXPECT_EQ(third.compare(root), -1);
  EXPECT_EQ(third.compare(0x1.5555555555555p-2), 1);
  EXPECT_EQ(third.compare(0x1.5555555555556p-2), -1);
  EXPECT_EQ(Time().compare(0.0), 0);
  const Time next = Time::roots_of(polynomial({-(Integer(1) << 200), 0, 2 * (Integer(1) << 200) + 1})).at(0);
  EXPECT_EQ(next.compare(root), -1);
  EXPECT_EQ(root.compare(next), 1);
  std::vector<Time> times = {root, third, same, Time(), next};
  sort_distinct(times);
  EXPECT_EQ(times.size(), 4U);
  EXPECT_EQ(times.front().compare(0.0), 0);
  EXPECT_EQ(times.back().compare(root), 0);
}

TEST(Times, LowerIsTheLargestDoubleNotAbove) {
  const auto lower = [](const Polynomial& p) { return Time::roots_of(p).at(0).lower(); };
  EXPECT_EQ(lower(root_at(1, 3)), 0x1.5555555555555p-2);
  EXPECT_EQ(lower(root_at(2, 3)), 0x1.5555555555555p-1);
  EXPECT_EQ(lower(root_at(3, 8)), 0.375);
  EXPECT_EQ(lower(root_at(0, 1)), 0.0);
  EXPECT_EQ(lower(root_at(1, 1)), 1.0);
  EXPECT_EQ(lower(polynomial({-1, 0, 2})), 0x1.6a09e667f3bccp-1);
  EXPECT_EQ(lower(polynomial({-1, Integer(1) << 2000})), 0.0);
  EXPECT_EQ(lower(polynomial({-1, Integer(1) << 1074})), 0x1p-1074);
  EXPECT_EQ(lower(polynomial({1 - (Integer(1) << 80), Integer(1) << 80})), 0x1.fffffffffffffp-1);
}

}  // namespace
}  // namespace noli::oracle
