// SPDX-License-Identifier: Apache-2.0

// g++ 12 wrongly reports a use after free in CGAL's reference counting at -O3.
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12
#pragma GCC diagnostic ignored "-Wuse-after-free"
#endif

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include <noli/cgal.h>
#include "kernel/arithmetic/algebraic.h"
#include "kernel/cgal_numbers.h"
#include "tests/kernel/random_queries.h"

namespace noli {
namespace {

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using test::Random;
using Real = AlgebraicKernel::Algebraic_real_1;

AlgebraicKernel::Polynomial_1 random_polynomial(Random& random) {
  std::vector<CGAL::Gmpz> c;
  for (int k = 1 + random.below(5); k >= 0; --k) c.emplace_back(random.around_zero(12));
  c.emplace_back(1 + random.below(12));
  return AlgebraicKernel::Polynomial_1(c.begin(), c.end());
}

/// CGAL's distinct roots in [0, 1].
std::vector<Real> cgal_roots(const AlgebraicKernel::Polynomial_1& p) {
  std::vector<std::pair<Real, int>> all;
  AlgebraicKernel().solve_1_object()(p, std::back_inserter(all));
  std::vector<Real> inside;
  for (const auto& [root, multiplicity] : all) {
    if (root >= Real(0) && root <= Real(1)) inside.push_back(root);
  }
  return inside;
}

TEST(Cgal, RootsAreThoseOfTheAlgebraicKernel) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const auto p = random_polynomial(random);
    const auto expected = cgal_roots(p);
    const auto roots = roots_in_unit_interval(cgal_detail::polynomial(p));
    ASSERT_EQ(roots.size(), expected.size());
    for (std::size_t k = 0; k < roots.size(); ++k) {
      const TimeOfImpact time(roots[k]);
      ASSERT_EQ(to_algebraic_real_1(time), expected[k]);
      ASSERT_EQ(from_algebraic_real_1(expected[k]), time);
    }
  }
}

TEST(Cgal, OrderAndSignsAreThoseOfTheAlgebraicKernel) {
  Random random(2);
  const auto sign_at = AlgebraicKernel().sign_at_1_object();
  for (int i = 0; i < 300; ++i) {
    const auto p = random_polynomial(random), q = random_polynomial(random);
    for (const auto& x : cgal_roots(p)) {
      const TimeOfImpact time = from_algebraic_real_1(x);
      ASSERT_EQ(time.algebraic().sign_of(cgal_detail::polynomial(q)), static_cast<int>(sign_at(q, x)));
      for (const auto& y : cgal_roots(q)) {
        const auto order = time <=> from_algebraic_real_1(y);
        ASSERT_EQ((order > 0) - (order < 0), static_cast<int>(CGAL::compare(x, y)));
      }
    }
  }
}

TEST(Cgal, DyadicAndRationalTimesConvert) {
  const auto construct = AlgebraicKernel().construct_algebraic_real_1_object();
  EXPECT_EQ(from_algebraic_real_1(construct(CGAL::Gmpq(3, 8))), TimeOfImpact::from_double(0.375));
  EXPECT_EQ(from_algebraic_real_1(construct(CGAL::Gmpq(1, 3))), TimeOfImpact::from_rational(1, 3));
  EXPECT_EQ(to_algebraic_real_1(TimeOfImpact::from_rational(1, 3)), construct(CGAL::Gmpq(1, 3)));
  EXPECT_EQ(to_algebraic_real_1(TimeOfImpact()), Real(0));
  EXPECT_THROW(from_algebraic_real_1(construct(CGAL::Gmpq(4, 3))), std::domain_error);
  EXPECT_THROW(from_algebraic_real_1(construct(CGAL::Gmpq(-1, 3))), std::domain_error);
}

template <class K>
typename K::Point_3 point(const Point3& p) {
  return {p[0], p[1], p[2]};
}

template <class K, class Functor>
auto ask(const Functor& functor, const VertexFace3& q) {
  const auto& [v0, a0, b0, c0] = q.x_t0;
  const auto& [v1, a1, b1, c1] = q.x_t1;
  return functor(point<K>(v0), point<K>(a0), point<K>(b0), point<K>(c0), point<K>(v1), point<K>(a1), point<K>(b1),
                 point<K>(c1));
}

template <class K>
void check_functors(std::uint64_t seed) {
  Random random(seed);
  std::array<int, 2> answers{};
  for (int i = 0; i < 300; ++i) {
    const auto q = test::random_query<VertexFace3>(random, test::Spread::small_integers);
    const auto expected = first_contact(q);
    ++answers[expected.has_value()];
    ASSERT_EQ((ask<K>(Vertex_face_contact_3<K>(), q)), expected.has_value());
    const auto first = ask<K>(Vertex_face_first_contact_3<K>(), q);
    const auto time = ask<K>(Vertex_face_time_of_impact_3<K>(), q);
    ASSERT_EQ(first.has_value(), expected.has_value());
    ASSERT_EQ(time.has_value(), expected.has_value());
    if (expected) {
      ASSERT_EQ(first->kind, expected->kind);
      ASSERT_EQ(*time, expected->time);
    }
  }
  EXPECT_GT(answers[0], 20);
  EXPECT_GT(answers[1], 20);
}

TEST(Cgal, FunctorsOverDoubles) { check_functors<Inexact>(3); }
TEST(Cgal, FunctorsOverAnExactNumberType) { check_functors<Exact>(4); }

TEST(Cgal, FunctorsInThePlane) {
  using P = Inexact::Point_2;
  const Vertex_edge_contact_2<Inexact> meet_2;
  EXPECT_TRUE(meet_2(P(0, 1), P(-1, 0), P(1, 0), P(0, -1), P(-1, 0), P(1, 0)));
  EXPECT_FALSE(meet_2(P(2, 1), P(-1, 0), P(1, 0), P(2, -1), P(-1, 0), P(1, 0)));
  EXPECT_TRUE(Vertex_vertex_contact_2<Inexact>()(P(0, 0), P(1, 1), P(2, 2), P(1, 1)));
  EXPECT_FALSE(Vertex_vertex_contact_2<Inexact>()(P(0, 0), P(1, 1), P(2, 3), P(1, 1)));
}

TEST(Cgal, CoordinatesThatAreNoDoublesAreRefused) {
  using P = Exact::Point_2;
  const P third(Exact::FT(1) / 3, 0), origin(0, 0);
  EXPECT_THROW(Vertex_vertex_contact_2<Exact>()(third, origin, third, origin), std::domain_error);
  EXPECT_NO_THROW(Vertex_vertex_contact_2<Exact>()(P(0.5, 0), origin, origin, origin));
}

}  // namespace
}  // namespace noli
