// SPDX-License-Identifier: Apache-2.0
#include "kernel/motion.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/kernel/motions.h"
#include "tests/kernel/random_queries.h"

namespace noli {
namespace {

using test::motion_over;
using test::prolonged;
using test::Random;
using test::Spread;

template <FeaturePair Pair, int Dim>
void expect_equal(const MotionQuery<Pair, Dim>& motion, const Query<Pair, Dim>& query, int i) {
  const auto answer = first_contact(motion), expected = first_contact(query);
  ASSERT_EQ(answer.has_value(), expected.has_value()) << "query " << i;
  if (!answer) return;
  ASSERT_EQ(name(answer->kind), name(expected->kind)) << "query " << i;
  ASSERT_EQ(answer->time, expected->time) << "query " << i;
}

/// Compares motions with their queries, and expects both answers to occur.
template <class Query>
void compare(std::uint64_t seed, int count, std::initializer_list<Spread> spreads, const auto& motion) {
  Random random(seed);
  int contacts = 0, apart = 0;
  for (int i = 0; i < count; ++i) {
    const auto spread = *(spreads.begin() + random.below(static_cast<int>(spreads.size())));
    const Query query = test::random_query<Query>(random, spread);
    expect_equal(motion(query, random), query, i);
    (first_contact(query) ? contacts : apart) += 1;
  }
  EXPECT_GT(contacts, count / 100);
  EXPECT_GT(apart, count / 100);
}

template <class Query>
class Motion : public testing::Test {};
using Queries = testing::Types<VertexFace3, EdgeEdge3, VertexEdge3, VertexVertex3, VertexEdge2, VertexVertex2>;
TYPED_TEST_SUITE(Motion, Queries);

TYPED_TEST(Motion, OverItsOwnTimeIsTheQuery) {
  compare<TypeParam>(1, 600, {Spread::tiny_integers, Spread::integers, Spread::doubles, Spread::any_magnitude},
                     [](const auto& query, Random&) { return motion_over(query, 0, 1); });
}

TYPED_TEST(Motion, TimeMayBeAnything) {
  compare<TypeParam>(2, 600, {Spread::tiny_integers, Spread::integers, Spread::doubles},
                     [](const auto& query, Random& random) {
                       constexpr std::array begins = {-1e300, -0.3, 0.0, 1e-300, 0.1, 123456.789};
                       const double begin = begins[static_cast<std::size_t>(random.below(6))];
                       return motion_over(query, begin, std::nextafter(begin, 2e300) + random.below(2) * 0.7);
                     });
}

/// The step is a third, a sixth, ... of longer paths, so that its fractions of them are not doubles.
TYPED_TEST(Motion, APieceOfLongerPathsIsTheQuery) {
  compare<TypeParam>(3, 600, {Spread::tiny_integers, Spread::integers},
                     [](const auto& query, Random& random) { return prolonged(query, random, 5); });
}

// --- at the border of two pieces

/// A vertex above (or below) a face around the origin, at the given heights at the times -1, 0 and 2.
struct Border {
  VertexFace3 before, after;
  ContactKind kind() const { return kind_at_border(motion_over(before, -1, 0), motion_over(after, 0, 2)); }
};

Border vertex_at(double x, std::array<double, 3> heights) {
  const std::array<Point3, 3> face = {{{-2, -2, 0}, {4, -2, 0}, {-2, 4, 0}}};
  const auto step = [&](double from, double to) {
    VertexFace3 q;
    q.x_t0 = {{{x, 0, from}, face[0], face[1], face[2]}};
    q.x_t1 = {{{x, 0, to}, face[0], face[1], face[2]}};
    return q;
  };
  return {step(heights[0], heights[1]), step(heights[1], heights[2])};
}

TEST(MotionBorder, FromOneSideToTheOtherIsCrossing) {
  EXPECT_EQ(vertex_at(0, {1, 0, -3}).kind(), ContactKind::crossing);
  EXPECT_EQ(vertex_at(0, {-2, 0, 0.5}).kind(), ContactKind::crossing);
}

TEST(MotionBorder, BackToTheSameSideIsTouching) {
  EXPECT_EQ(vertex_at(0, {1, 0, 3}).kind(), ContactKind::touching);
  EXPECT_EQ(vertex_at(0, {-1, 0, -3}).kind(), ContactKind::touching);
}

TEST(MotionBorder, AtTheRimIsTouching) {
  EXPECT_EQ(vertex_at(2, {1, 0, -3}).kind(), ContactKind::touching);  // on the edge from (4, -2) to (-2, 4)
}

TEST(MotionBorder, StayingIsPersistent) { EXPECT_EQ(vertex_at(0, {1, 0, 0}).kind(), ContactKind::persistent); }

TEST(MotionBorder, EdgesCrossTouchOrStay) {
  EdgeEdge3 before, after;
  before.x_t0 = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 1}, {0, 1, 1}}};
  before.x_t1 = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}};
  after.x_t0 = before.x_t1;
  after.x_t1 = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, -1}, {0, 1, -1}}};
  EXPECT_EQ(kind_at_border(motion_over(before, 0, 1), motion_over(after, 1, 2)), ContactKind::crossing);
  after.x_t1 = before.x_t0;
  EXPECT_EQ(kind_at_border(motion_over(before, 0, 1), motion_over(after, 1, 2)), ContactKind::touching);
  after.x_t1 = after.x_t0;
  EXPECT_EQ(kind_at_border(motion_over(before, 0, 1), motion_over(after, 1, 2)), ContactKind::persistent);
}

/// The second edge turns into the plane of the first and slides onto it; until then the determinant is -2 (1 - s)^2.
TEST(MotionBorder, TheFirstDerivativeThatIsNotZeroTellsTheSign) {
  EdgeEdge3 before, after;
  before.x_t0 = {{{-1, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 2, 1}}};
  before.x_t1 = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}};
  after.x_t0 = before.x_t1;
  for (const double up : {1.0, -1.0}) {
    after.x_t1 = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, up}, {0, 1, up}}};
    EXPECT_EQ(kind_at_border(motion_over(before, 0, 1), motion_over(after, 1, 2)),
              up > 0 ? ContactKind::crossing : ContactKind::touching);
  }
}

TEST(MotionBorder, InThePlaneAVertexCrossesAnEdge) {
  VertexEdge2 before, after;
  before.x_t0 = {{{0, 1}, {-1, 0}, {1, 0}}};
  before.x_t1 = {{{0, 0}, {-1, 0}, {1, 0}}};
  after.x_t0 = before.x_t1;
  after.x_t1 = {{{1, -1}, {-1, 0}, {1, 0}}};
  EXPECT_EQ(kind_at_border(motion_over(before, 0, 1), motion_over(after, 1, 2)), ContactKind::crossing);
  after.x_t1[0] = {1, 1};
  EXPECT_EQ(kind_at_border(motion_over(before, 0, 1), motion_over(after, 1, 2)), ContactKind::touching);
}

TEST(MotionBorder, VerticesThatMeetTouch) {
  VertexVertex3 before, after;
  before.x_t0 = {{{1, 0, 0}, {-1, 0, 0}}};
  before.x_t1 = {{{0, 0, 0}, {0, 0, 0}}};
  after.x_t0 = before.x_t1;
  after.x_t1 = {{{-1, 0, 0}, {1, 0, 0}}};
  EXPECT_EQ(kind_at_border(motion_over(before, 0, 1), motion_over(after, 1, 2)), ContactKind::touching);
  after.x_t1 = {{{5, 0, 0}, {5, 0, 0}}};
  EXPECT_EQ(kind_at_border(motion_over(before, 0, 1), motion_over(after, 1, 2)), ContactKind::persistent);
}

}  // namespace
}  // namespace noli
