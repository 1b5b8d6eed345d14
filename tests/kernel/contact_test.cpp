// SPDX-License-Identifier: Apache-2.0
//
// Compares contact, and each stage that decides it, with the oracle.
#include <noli/contact.h>

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "kernel/arithmetic/rounding.h"
#include "kernel/arithmetic/scaled_integers.h"
#include "kernel/double_filter.h"
#include "kernel/exact_contact.h"
#include "kernel/interval_filter.h"
#include "oracle/oracle.h"
#include "tests/kernel/oracle_motion.h"
#include "tests/kernel/random_query.h"

namespace noli {
namespace {

using bernstein::Verdict;
using test::Coordinates;

template <class Query>
std::string text(const Query& q) {
  std::ostringstream out;
  out << std::hexfloat;
  for (const auto* points : {&q.x_t0, &q.x_t1}) {
    for (const auto& point : *points) {
      for (const double x : point) out << x << ' ';
      out << '\n';
    }
  }
  return out.str();
}

/// Compares contact and its enclosure with the oracle, and expects both answers to occur.
template <FeaturePair Pair, int Dim>
void compare_with_oracle(Coordinates how, int count, StageCounters& counters) {
  std::mt19937_64 random(static_cast<std::uint64_t>(how) + 1);
  int contacts = 0;
  for (int i = 0; i < count; ++i) {
    const auto q = test::any_query<Pair, Dim>(how, random);
    const auto found = contact(q, &counters);
    const oracle::Answer truth = oracle::first_contact(test::motion_of(q));
    ASSERT_EQ(found.has_value(), truth.time.has_value()) << text(q);
    if (!found) continue;
    ++contacts;
    ASSERT_LE(0, found->begin);
    ASSERT_LE(found->end, 1);
    ASSERT_GE(truth.time->compare(found->begin), 0) << text(q);
    ASSERT_LE(truth.time->compare(found->end), 0) << text(q);
  }
  if (how == Coordinates::tiny_grid) {
    EXPECT_GT(contacts, count / 100);
    EXPECT_LT(contacts, count);
  }
}

template <FeaturePair Pair, int Dim>
StageCounters compare_all(int count) {
  StageCounters counters;
  for (const Coordinates how : test::all_coordinates) compare_with_oracle<Pair, Dim>(how, count, counters);
  return counters;
}

TEST(Contact, VertexFaceAgreesWithTheOracleInEveryStage) {
  const StageCounters counters = compare_all<FeaturePair::vertex_face, 3>(3000);
  for (const Stage stage : all_stages) EXPECT_GT(counters[stage], 0U) << name(stage);
}

TEST(Contact, EdgeEdgeAgreesWithTheOracleInEveryStage) {
  const StageCounters counters = compare_all<FeaturePair::edge_edge, 3>(3000);
  for (const Stage stage : all_stages) EXPECT_GT(counters[stage], 0U) << name(stage);
}

TEST(Contact, VertexEdgeAndVertexVertexAgreeWithTheOracle) {
  compare_all<FeaturePair::vertex_edge, 3>(2000);
  compare_all<FeaturePair::vertex_vertex, 3>(2000);
  compare_all<FeaturePair::vertex_edge, 2>(2000);
  compare_all<FeaturePair::vertex_vertex, 2>(2000);
}

// --- Each stage alone must be right or give no answer ---------------------------------------------------------------

struct StageResult {
  int wrong = 0;
  int contact = 0;
  int apart = 0;

  void add(Verdict verdict, bool truth) {
    contact += verdict == Verdict::contact;
    apart += verdict == Verdict::apart;
    wrong += verdict != Verdict::unknown && (verdict == Verdict::contact) != truth;
  }
};

void expect_useful(const StageResult& result) {
  EXPECT_EQ(result.wrong, 0);
  EXPECT_GT(result.contact, 0);
  EXPECT_GT(result.apart, 0);
}

template <class Filter, class Query>
void add_float_stages(const Query& q, bool truth, StageResult& direction, StageResult& roots, StageResult& search,
                      StageResult& interval) {
  if (rounding_self_test().directed_ok) interval.add(interval_filter::decide(q).verdict, truth);
  const filter::Separation separation = filter::separate(q);
  if (separation.separated) direction.add(Verdict::apart, truth);
  const Filter filter(q, separation);
  if (!filter.usable()) return;
  bool near_border = false;
  roots.add(filter::search_roots(filter, near_border).verdict, truth);
  search.add(filter::search(filter.forms(), filter.axis(), filter.signs()).verdict, truth);
}

template <class Filter, FeaturePair Pair>
void check_float_stages() {
  StageResult direction, roots, search, interval;
  std::mt19937_64 random(7);
  for (const Coordinates how : test::all_coordinates) {
    for (int i = 0; i < 2000; ++i) {
      const auto q = test::any_query<Pair, 3>(how, random);
      const bool truth = oracle::first_contact(test::motion_of(q)).time.has_value();
      add_float_stages<Filter>(q, truth, direction, roots, search, interval);
    }
  }
  EXPECT_EQ(direction.wrong, 0);
  EXPECT_GT(direction.apart, 0);
  expect_useful(roots);
  expect_useful(search);
  if (rounding_self_test().directed_ok) expect_useful(interval);
}

/// The filter computes the cubic for both ends at once. It must equal the formula's exactly, not only within bounds.
template <class Filter, FeaturePair Pair>
void expect_cubic_of_the_formula() {
  std::mt19937_64 random(9);
  for (const Coordinates how : test::all_coordinates) {
    for (int i = 0; i < 500; ++i) {
      const auto q = test::any_query<Pair, 3>(how, random);
      const filter::Separation separation = filter::separate(q);
      const Filter filter(q, separation);
      if (!filter.usable()) continue;
      EXPECT_EQ(filter.coplanarity(), bernstein::scaled_coefficients(filter.forms().coplanarity()));
    }
  }
}

TEST(Stages, BothEndsAtOnceGiveTheFormula) {
  expect_cubic_of_the_formula<filter::VertexFaceFilter, FeaturePair::vertex_face>();
  expect_cubic_of_the_formula<filter::EdgeEdgeFilter, FeaturePair::edge_edge>();
}

TEST(Stages, FloatingPointIsSilentOrRightForVertexFace) {
  check_float_stages<filter::VertexFaceFilter, FeaturePair::vertex_face>();
}

TEST(Stages, FloatingPointIsSilentOrRightForEdgeEdge) {
  check_float_stages<filter::EdgeEdgeFilter, FeaturePair::edge_edge>();
}

/// Tests one limb and two limbs, starting with each axis.
template <FeaturePair Pair>
void check_fixed_width() {
  StageResult one_limb, two_limbs;
  std::mt19937_64 random(8);
  for (const Coordinates how :
       {Coordinates::tiny_grid, Coordinates::floats, Coordinates::doubles, Coordinates::nudged_grid}) {
    for (int i = 0; i < 1500; ++i) {
      const auto q = test::any_query<Pair, 3>(how, random);
      const bool truth = oracle::first_contact(test::motion_of(q)).time.has_value();
      const exact::ExponentRange range = exact::exponent_range(q);
      const std::size_t axis = static_cast<std::size_t>(i) % 3;
      if (range.bits() <= 59) one_limb.add(exact::decide<Pair>(exact::scaled<Wide<1>>(q, range), axis).verdict, truth);
      if (range.bits() <= 123)
        two_limbs.add(exact::decide<Pair>(exact::scaled<Wide<2>>(q, range), axis).verdict, truth);
    }
  }
  expect_useful(one_limb);
  expect_useful(two_limbs);
}

TEST(Stages, FixedWidthIsSilentOrRightForVertexFace) { check_fixed_width<FeaturePair::vertex_face>(); }

TEST(Stages, FixedWidthIsSilentOrRightForEdgeEdge) { check_fixed_width<FeaturePair::edge_edge>(); }

// --- By hand --------------------------------------------------------------------------------------------------------

/// A vertex that falls from z_t0 to z_t1 above (x, y), onto the face (0,0,0) (1,0,0) (0,1,0).
VertexFace3 falling(double x, double y, double z_t0, double z_t1) {
  const Point3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  return {{Point3{x, y, z_t0}, a, b, c}, {Point3{x, y, z_t1}, a, b, c}};
}

TEST(Contact, ATouchIsAContactAndOneUlpLessIsNot) {
  EXPECT_TRUE(meet(falling(0.25, 0.25, 1, 0)));
  EXPECT_FALSE(meet(falling(0.25, 0.25, 1, 0x1p-1074)));
  EXPECT_TRUE(meet(falling(0.5, 0.5, 1, -1)));  // on the edge
  EXPECT_FALSE(meet(falling(0.5, std::nextafter(0.5, 1), 1, -1)));
  EXPECT_TRUE(meet(falling(0, 0, 1, -1)));  // on the corner
  EXPECT_FALSE(meet(falling(-0x1p-1074, 0, 1, -1)));
}

TEST(Contact, AContactAtAnEndOfTheStepCounts) {
  const auto at_begin = contact(falling(0.25, 0.25, 0, 1));
  ASSERT_TRUE(at_begin);
  EXPECT_EQ(at_begin->begin, 0);
  EXPECT_EQ(at_begin->end, 0);
  const auto at_end = contact(falling(0.25, 0.25, 1, 0));
  ASSERT_TRUE(at_end);
  EXPECT_EQ(at_end->end, 1);
}

TEST(Contact, TwoCrossingsInOneStepAreSeen) {
  // The face turns in the plane z = (2 t - 1) x. Its height below the vertex is 2 (t - 1/2)^2, which is 1/8 at t = 1/4
  // and at t = 3/4.
  VertexFace3 q{{Point3{-0.5, -0.5, 0.125}, Point3{-1, -1, 1}, Point3{1, -1, -1}, Point3{0, 1, 0}},
                {Point3{0.5, -0.5, 0.125}, Point3{-1, -1, -1}, Point3{1, -1, 1}, Point3{0, 1, 0}}};
  const auto first = contact(q);
  ASSERT_TRUE(first);
  EXPECT_LE(first->begin, 0.25);
  EXPECT_GE(first->end, 0.25);
  EXPECT_LT(first->end, 0.75);
  q.x_t0[0][2] = q.x_t1[0][2] = -0x1p-60;  // now the vertex stays below
  EXPECT_FALSE(meet(q));
}

TEST(Contact, ADegenerateFaceIsItsHull) {
  VertexFace3 q = falling(0.5, 0, 1, -1);
  for (auto* x : {&q.x_t0, &q.x_t1}) (*x)[3] = {2, 0, 0};  // the face is the segment from 0 to (2, 0, 0)
  EXPECT_TRUE(meet(q));
  q.x_t0[0][0] = q.x_t1[0][0] = 2.5;
  EXPECT_FALSE(meet(q));
}

TEST(Contact, EdgesThatOverlapOnALineMeet) {
  EdgeEdge3 q{{Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{2, 0, 0}, Point3{3, 0, 0}},
              {Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{2, 0, 0}, Point3{3, 0, 0}}};
  EXPECT_FALSE(meet(q));
  q.x_t1[2][0] = 1;
  EXPECT_TRUE(meet(q));
  q.x_t1[2][0] = std::nextafter(1.0, 2.0);
  EXPECT_FALSE(meet(q));
}

/// At t = 1/2 the face is a point. The simple root of the cubic, t = 1/4, has a numerator and a denominator beyond the
/// range of double.
TEST(Contact, ARootTooLargeForDoubleIsStillARoot) {
  for (const double x : {0x1p-80, 0x1p-112, 0x1p-115}) {
    const VertexFace3 q{{Point3{x, 0, -2}, Point3{-1, -1, 0}, Point3{2, -1, 0}, Point3{-1, 2, 0}},
                        {Point3{x, 0, 6}, Point3{-1, -1, 0}, Point3{-4, -1, 0}, Point3{-1, -4, 0}}};
    EXPECT_FALSE(meet(q)) << x;
    VertexFace3 hit = q;
    hit.x_t0[0][0] = hit.x_t1[0][0] = -0.25 - x;
    hit.x_t0[0][1] = hit.x_t1[0][1] = -0.25;
    EXPECT_TRUE(meet(hit)) << x;
  }
}

TEST(Contact, ARootNearTheBeginOfTheStepIsFoundOnBothItsSides) {
  const double e = 0x1p-34, z = 0x1p-3;
  EXPECT_TRUE(
      meet(VertexFace3{{Point3{e, 0, -e * z}, Point3{0, -10, 0}, Point3{10, 0, 0}, Point3{0, 10, 0}},
                       {Point3{1 + e, 0, (1 - e) * z}, Point3{0, -11, 0}, Point3{12, 0, 0}, Point3{0, 10, 0}}}));
  EXPECT_TRUE(meet(
      EdgeEdge3{{Point3{e, -10, -e * z}, Point3{e, 11, -e * z}, Point3{0, 0, 0}, Point3{10, 1, 0}},
                {Point3{1 + e, -12, (1 - e) * z}, Point3{1 + e, 10, (1 - e) * z}, Point3{0, 0, 0}, Point3{13, 0, 0}}}));
}

TEST(Contact, TwoRootsNextToEachOtherAreKeptApart) {
  const double first = 0.5 - 0x1p-24, second = 0.5 + 0x1p-24, t = first - 0x1p-28, z = 0x1p-12, y = 0x1p-30;
  EXPECT_TRUE(meet(VertexFace3{
      {Point3{-t / 4, y, -second * z}, Point3{0, 0, 0}, Point3{-first, 0, 0}, Point3{0, 1, 0}},
      {Point3{(1 - t) / 4, y, (1 - second) * z}, Point3{0, 0, 0}, Point3{1 - first, 0, 0}, Point3{0, 2, 0}}}));
  EXPECT_FALSE(meet(EdgeEdge3{{Point3{2, -1, 0}, Point3{2, -1, -1}, Point3{-1, 0, -2}, Point3{1, -2, 0}},
                              {Point3{2, -1, 1}, Point3{-2, -2, 0}, Point3{-2, 1, 2}, Point3{-1, 0, 1}}}));
}

/// Shrinking one axis by a power of two must not change the answer.
template <FeaturePair Pair>
void compare_shrunk() {
  std::mt19937_64 random(9);
  for (int i = 0; i < 100'000; ++i) {
    const auto q = test::any_query<Pair, 3>(Coordinates::tiny_grid, random);
    auto shrunk = q;
    for (auto* points : {&shrunk.x_t0, &shrunk.x_t1}) {
      for (auto& point : *points) point[static_cast<std::size_t>(i) % 3] *= 0x1p-48;
    }
    ASSERT_EQ(meet(q), meet(shrunk)) << text(q);
  }
}

TEST(Contact, ShrinkingAnAxisChangesNoAnswer) {
  compare_shrunk<FeaturePair::vertex_face>();
  compare_shrunk<FeaturePair::edge_edge>();
}

TEST(Contact, ExtremeScalesGiveTheSameAnswers) {
  for (const int exponent : {-1060, -600, 0, 600, 1000}) {
    const double s = std::ldexp(1.0, exponent);
    VertexFace3 hit = falling(0.25, 0.25, 1, -1), miss = falling(0.75, 0.75, 1, -1);
    for (VertexFace3* q : {&hit, &miss}) {
      for (auto* points : {&q->x_t0, &q->x_t1}) {
        for (auto& point : *points) {
          for (double& x : point) x *= s;
        }
      }
    }
    EXPECT_TRUE(meet(hit)) << exponent;
    EXPECT_FALSE(meet(miss)) << exponent;
  }
}

}  // namespace
}  // namespace noli
