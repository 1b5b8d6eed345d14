// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <noli/time_of_impact.h>
#include "kernel/arithmetic/algebraic.h"
#include "tests/kernel/oracle_motion.h"
#include "tests/kernel/random_queries.h"

namespace noli {
namespace {

using test::Random;

constexpr std::array kinds = {ContactKind::apart, ContactKind::touching, ContactKind::crossing,
                              ContactKind::persistent};

template <class Query>
ContactKind kind_of(const Query& query) {
  const auto contact = first_contact(query);
  return contact ? contact->kind : ContactKind::apart;
}

template <class Query>
double time_of(const Query& query) {
  const auto contact = first_contact(query);
  return contact ? contact->time.lower() : -1;
}

// --- against the oracle

/// Compares the kind, the first double, and the order of successive contact times. Expects every possible kind to
/// occur.
template <class Query>
void compare_with_oracle(std::uint64_t seed, int count, int kinds_possible) {
  Random random(seed);
  std::array<int, kinds.size()> seen{};
  std::optional<std::pair<TimeOfImpact, oracle::Time>> previous;
  for (int i = 0; i < count; ++i) {
    const Query query = test::random_query<Query>(random);
    const auto expected = oracle::first_contact(test::motion_of(query));
    const auto answer = first_contact(query);
    const ContactKind kind = answer ? answer->kind : ContactKind::apart;
    ASSERT_EQ(name(kind), oracle::name(expected.kind)) << "query " << i;
    ++seen[static_cast<std::size_t>(kind)];
    if (!answer) continue;
    ASSERT_EQ(answer->time.lower(), expected.time->lower()) << "query " << i;
    if (previous) {
      const auto order = answer->time <=> previous->first;
      ASSERT_EQ((order > 0) - (order < 0), expected.time->compare(previous->second)) << "query " << i;
    }
    previous.emplace(answer->time, *expected.time);
  }
  int different = 0;
  for (const int n : seen) different += n > count / 100;
  EXPECT_EQ(different, kinds_possible);
}

TEST(FirstContact, VertexFaceAsOracle) { compare_with_oracle<VertexFace3>(1, 1000, 4); }
TEST(FirstContact, EdgeEdgeAsOracle) { compare_with_oracle<EdgeEdge3>(2, 1000, 4); }
TEST(FirstContact, VertexEdgeAsOracle) { compare_with_oracle<VertexEdge3>(3, 2000, 3); }
TEST(FirstContact, VertexVertexAsOracle) { compare_with_oracle<VertexVertex3>(4, 4000, 3); }
TEST(FirstContact, VertexEdgeInThePlaneAsOracle) { compare_with_oracle<VertexEdge2>(5, 2000, 4); }
TEST(FirstContact, VertexVertexInThePlaneAsOracle) { compare_with_oracle<VertexVertex2>(6, 4000, 3); }

/// All pairs of many contact times, equal ones included, must compare as in the oracle.
TEST(SlowFirstContact, MillionPairsOfTimesCompareAsOracle) {
  Random random(7);
  std::vector<std::pair<TimeOfImpact, oracle::Time>> times;
  while (times.size() < 1500) {
    const auto how = test::all_spreads[static_cast<std::size_t>(random.below(5))];
    const auto query = test::random_query<VertexFace3>(random, how);
    const auto answer = first_contact(query);
    if (!answer || answer->time == TimeOfImpact()) continue;
    times.emplace_back(answer->time, *oracle::first_contact(test::motion_of(query)).time);
  }
  std::array<int, 2> equal{};
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto order = times[i].first <=> times[j].first;
      ASSERT_EQ((order > 0) - (order < 0), times[i].second.compare(times[j].second));
      ASSERT_EQ(times[i].first == times[j].first, order == 0);
      ++equal[order == 0];
    }
  }
  EXPECT_GT(equal[0] + equal[1], 1000000);
  EXPECT_GT(equal[1], 10000);
}

// --- constructed from a known time

/// A vertex that passes through the plane of a face with corners (0,0), (4,0), (0,4) at (x, y), at time t0 = 1/4.
VertexFace3 piercing(double x, double y) {
  VertexFace3 q;
  q.x_t0 = {{{x, y, 1}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  q.x_t1 = {{{x, y, -3}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  return q;
}

TEST(FirstContact, VertexThroughTheInteriorOfAFace) {
  EXPECT_EQ(kind_of(piercing(1, 1)), ContactKind::crossing);
  EXPECT_EQ(time_of(piercing(1, 1)), 0.25);
}

TEST(FirstContact, VertexThroughTheBorderOfAFaceTouches) {
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.0, 2.0}, {2.0, 2.0}, {4.0, 0.0}}) {
    EXPECT_EQ(kind_of(piercing(x, y)), ContactKind::touching);
    EXPECT_EQ(time_of(piercing(x, y)), 0.25);
  }
  EXPECT_EQ(kind_of(piercing(2, std::nextafter(2.0, 3.0))), ContactKind::apart);
  EXPECT_EQ(kind_of(piercing(-0x1p-1074, 1)), ContactKind::apart);
  EXPECT_EQ(kind_of(piercing(0x1p-1074, 1)), ContactKind::crossing);
}

TEST(FirstContact, AtAnEndOfTheStepItTouches) {
  VertexFace3 q = piercing(1, 1);
  q.x_t1[0][2] = 0;
  EXPECT_EQ(kind_of(q), ContactKind::touching);
  EXPECT_EQ(time_of(q), 1);
  std::swap(q.x_t0, q.x_t1);
  EXPECT_EQ(kind_of(q), ContactKind::touching);
  EXPECT_EQ(time_of(q), 0);
}

/// The vertex moves in the plane of the face and enters it at t = 1/2.
TEST(FirstContact, SlidingIntoAFaceLasts) {
  VertexFace3 q = piercing(1, 1);
  q.x_t0[0] = {-1, 1, 0};
  q.x_t1[0] = {1, 1, 0};
  EXPECT_EQ(kind_of(q), ContactKind::persistent);
  EXPECT_EQ(time_of(q), 0.5);
  q.x_t0[0] = {-1, 1, 0};
  q.x_t1[0] = {1, -1, 0};  // only through the corner
  EXPECT_EQ(kind_of(q), ContactKind::touching);
  EXPECT_EQ(time_of(q), 0.5);
  q.x_t1[0] = {0, 1, 0};  // arrives at the last instant
  EXPECT_EQ(kind_of(q), ContactKind::touching);
  EXPECT_EQ(time_of(q), 1);
}

/// Edges along x and y; the first sinks through the second at t = 1/3.
TEST(FirstContact, EdgesCross) {
  EdgeEdge3 q;
  q.x_t0 = {{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}}};
  q.x_t1 = {{{-1, 0, -2}, {1, 0, -2}, {0, -1, 0}, {0, 1, 0}}};
  EXPECT_EQ(kind_of(q), ContactKind::crossing);
  EXPECT_EQ(first_contact(q)->time, TimeOfImpact::from_rational(1, 3));
  q.x_t0[0][0] = q.x_t1[0][0] = 0;  // an end of the first passes
  EXPECT_EQ(kind_of(q), ContactKind::touching);
}

/// The orientation is proportional to (1 - 2 t)^2: it touches and turns back.
TEST(FirstContact, DoubleRootTouches) {
  VertexEdge2 q;
  q.x_t0 = {{{1, 1}, {0, 0}, {2, 0}}};
  q.x_t1 = {{{1, 0}, {0, 0}, {2, 0}}};
  EXPECT_EQ(kind_of(q), ContactKind::touching);
  q.x_t0 = {{{0, 0}, {-1, 1}, {1, 1}}};
  q.x_t1 = {{{0, 0}, {-1, -1}, {1, -1}}};
  EXPECT_EQ(kind_of(q), ContactKind::crossing);
  EXPECT_EQ(time_of(q), 0.5);
  // (1 - 2 t) times itself: the edge turns as it sinks
  q.x_t0 = {{{0, 0}, {-1, 1}, {1, 1}}};
  q.x_t1 = {{{0, 0}, {1, -1}, {-1, -1}}};
  EXPECT_EQ(kind_of(q), ContactKind::touching);
  EXPECT_EQ(time_of(q), 0.5);
}

/// A root of 2 t^2 = 1, from coordinates that do not reveal it.
TEST(FirstContact, IrrationalTimes) {
  VertexEdge2 q;
  q.x_t0 = {{{0, 0}, {-1, -1}, {1, -1}}};
  q.x_t1 = {{{0, 0}, {-1, 1}, {1, 0}}};
  const auto contact = first_contact(q);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->kind, ContactKind::crossing);
  EXPECT_EQ(contact->time, TimeOfImpact::from_rational(2, 3));
  q.x_t1 = {{{0, 0}, {-1, 1}, {3, 0}}};
  const TimeOfImpact irrational = first_contact(q)->time;
  EXPECT_FALSE(irrational.algebraic().is_rational());
  EXPECT_LT(irrational.lower(), irrational.upper());
}

TEST(FirstContact, VerticesMeetOnlyWhereAllCoordinatesDo) {
  VertexVertex3 q;
  q.x_t0 = {{{0, 0, 0}, {1, 2, 3}}};
  q.x_t1 = {{{3, 6, 9}, {1, 2, 3}}};
  EXPECT_EQ(first_contact(q)->time, TimeOfImpact::from_rational(1, 3));
  EXPECT_EQ(kind_of(q), ContactKind::touching);
  q.x_t1[0][2] = std::nextafter(9.0, 10.0);
  EXPECT_EQ(kind_of(q), ContactKind::apart);
  q.x_t0[1] = q.x_t0[0];
  q.x_t1[1] = q.x_t1[0];
  EXPECT_EQ(kind_of(q), ContactKind::persistent);
}

/// Coordinates of all magnitudes in one query.
TEST(FirstContact, ExtremeMagnitudes) {
  VertexFace3 q;
  q.x_t0 = {{{0, 0, 1e-308}, {-1e308, -1e308, 0}, {1e308, -1e308, 0}, {0, 1e308, 0}}};
  q.x_t1 = q.x_t0;
  q.x_t1[0][2] = -1e308;
  EXPECT_EQ(kind_of(q), ContactKind::crossing);
  EXPECT_EQ(time_of(q), 0);  // 1e-616 is below all doubles but zero
  EXPECT_EQ(first_contact(q)->time.upper(), 0x1p-1074);
  q.x_t1[0][2] = 0x1p-1074;
  EXPECT_EQ(kind_of(q), ContactKind::apart);
}

}  // namespace
}  // namespace noli
