// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <noli/time_of_impact.h>
#include "kernel/thickness.h"
#include "tests/kernel/motions.h"
#include "tests/kernel/oracle_motion.h"
#include "tests/kernel/random_queries.h"

namespace noli {
namespace {

using test::Random;

double random_eta(Random& random) {
  switch (random.below(5)) {
    case 0: return 0;
    case 1: return 1 + random.below(3);
    case 2: return 0.25 * random.below(8);
    case 3: return random.unit();
    default: return std::ldexp(1.0, -random.below(60));
  }
}

/// Compares the answer and the first double with the oracle, and expects both answers to occur often enough.
template <class Query>
void compare_with_oracle(std::uint64_t seed, int count) {
  Random random(seed);
  std::array<int, 2> answers{};
  for (int i = 0; i < count; ++i) {
    const auto how = test::all_spreads[static_cast<std::size_t>(random.below(5))];
    const Query query = test::random_query<Query>(random, how);
    const double eta = random_eta(random);
    const auto expected = oracle::first_within(test::motion_of(query), eta);
    const auto answer = first_within(query, eta);
    ++answers[answer.has_value()];
    ASSERT_EQ(answer.has_value(), expected.has_value()) << "query " << i << " eta " << eta;
    ASSERT_EQ(within_distance(query, eta), answer.has_value()) << "query " << i;
    if (answer) {
      ASSERT_EQ(answer->lower(), expected->lower()) << "query " << i << " eta " << eta;
    }
  }
  EXPECT_GT(answers[0], count / 20);
  EXPECT_GT(answers[1], count / 20);
}

TEST(Thickness, VertexFaceAsOracle) { compare_with_oracle<VertexFace3>(1, 400); }
TEST(Thickness, EdgeEdgeAsOracle) { compare_with_oracle<EdgeEdge3>(2, 400); }
TEST(Thickness, VertexEdgeAsOracle) { compare_with_oracle<VertexEdge3>(3, 1000); }
TEST(Thickness, VertexVertexAsOracle) { compare_with_oracle<VertexVertex3>(4, 1000); }
TEST(Thickness, VertexEdgeInThePlaneAsOracle) { compare_with_oracle<VertexEdge2>(5, 1000); }
TEST(Thickness, VertexVertexInThePlaneAsOracle) { compare_with_oracle<VertexVertex2>(6, 1000); }

/// A piece of longer paths must give the same answer as the query of that piece; both answers occur often enough.
template <class Query>
void compare_pieces(std::uint64_t seed, int count) {
  Random random(seed);
  std::array<int, 2> answers{};
  for (int i = 0; i < count; ++i) {
    const Query query =
        test::random_query<Query>(random, i % 2 == 0 ? test::Spread::small_integers : test::Spread::integers);
    const double eta = random_eta(random);
    const auto expected = first_within(query, eta), answer = first_within(test::prolonged(query, random, 3), eta);
    ++answers[answer.has_value()];
    ASSERT_EQ(answer.has_value(), expected.has_value()) << "query " << i << " eta " << eta;
    if (answer) {
      ASSERT_EQ(*answer, *expected) << "query " << i << " eta " << eta;
    }
  }
  EXPECT_GT(answers[0], count / 20);
  EXPECT_GT(answers[1], count / 20);
}

TEST(Thickness, PiecesOfPathsAsQueries) {
  compare_pieces<VertexFace3>(11, 300);
  compare_pieces<EdgeEdge3>(12, 300);
  compare_pieces<VertexEdge3>(13, 300);
  compare_pieces<VertexVertex3>(14, 300);
  compare_pieces<VertexEdge2>(15, 300);
  compare_pieces<VertexVertex2>(16, 300);
}

TEST(Thickness, WithinZeroIsContact) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const auto query = test::random_query<VertexFace3>(random);
    const auto contact = first_contact(query);
    const auto within = first_within(query, 0);
    ASSERT_EQ(within.has_value(), contact.has_value());
    if (within) {
      ASSERT_EQ(within->lower(), contact->time.lower());
    }
  }
}

/// A vertex above the middle of a face that sinks from height 2 to 1.
const VertexFace3 sinking{{{{0, 0, 2}, {-3, -3, 0}, {3, -3, 0}, {0, 3, 0}}},
                          {{{0, 0, 1}, {-3, -3, 0}, {3, -3, 0}, {0, 3, 0}}}};

/// Two collinear edges share an end, and products of their coordinates overflow to both sides. Their sum is NaN, which
/// an earlier version lost in the next comparison. Found by fuzzing.
TEST(Thickness, WhatOverflowsSeparatesNothing) {
  const double a = 0x1.54p+515, b = -0x1.bp+515, c = -0x1.8cp+515;
  const EdgeEdge3 query{{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {a, 0, 0}}}, {{{0, 0, 0}, {b, 0, 0}, {0, 0, 0}, {c, 0, 0}}}};
  const auto time = first_within(query, 0);
  ASSERT_TRUE(time.has_value());
  EXPECT_EQ(time->lower(), 0);
  EXPECT_TRUE(within_distance(query, 1));
  EdgeEdge3 apart = query;
  for (auto* x : {&apart.x_t0, &apart.x_t1}) (*x)[2][1] = (*x)[3][1] = 2;
  EXPECT_FALSE(within_distance(apart, 1));
  EXPECT_TRUE(within_distance(apart, 2));
}

TEST(Thickness, ClosedAtTheEndOfTheStep) {
  const auto last = first_within(sinking, 1);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->lower(), 1);
  EXPECT_EQ(last->upper(), 1);
  EXPECT_FALSE(within_distance(sinking, std::nextafter(1.0, 0.0)));
  EXPECT_EQ(first_within(sinking, 1.5)->lower(), 0.5);
  EXPECT_EQ(first_within(sinking, 2)->lower(), 0);
  EXPECT_GT(first_within(sinking, std::nextafter(2.0, 0.0))->lower(), 0);
}

/// The answer does not depend on a common power of two.
TEST(Thickness, ScalesWithPowersOfTwo) {
  for (const int exponent : {-1000, -500, 0, 500, 1000}) {
    VertexFace3 scaled = sinking;
    for (auto* points : {&scaled.x_t0, &scaled.x_t1}) {
      for (auto& p : *points) {
        for (double& x : p) x = std::ldexp(x, exponent);
      }
    }
    EXPECT_TRUE(within_distance(scaled, std::ldexp(1.0, exponent)));
    EXPECT_FALSE(within_distance(scaled, std::nextafter(std::ldexp(1.0, exponent), 0.0)));
  }
}

TEST(Thickness, ConstantDistanceIsWithinFromTheStart) {
  EdgeEdge3 parallel{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}, {{{5, 0, 3}, {6, 0, 3}, {5, 1, 3}, {6, 1, 3}}}};
  EXPECT_EQ(first_within(parallel, 1)->upper(), 0);
  EXPECT_FALSE(within_distance(parallel, std::nextafter(1.0, 0.0)));
}

}  // namespace
}  // namespace noli
