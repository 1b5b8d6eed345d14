// SPDX-License-Identifier: Apache-2.0
//
// Compares the decisions of certificates with rational arithmetic on the extrapolated motion. No decision is late by an
// ulp, and failure times are not early by an ulp either.
#include "certificates/decisions.h"

#include <gtest/gtest.h>

#include "certificates/cells.h"
#include "certificates_kicks.h"
#include "tests/support/every_pair.h"

namespace noli::certificates {
namespace {

using test::Fault;
using test::KickOptions;
using test::RandomKicks;

constexpr double for_ever = std::numeric_limits<double>::infinity();

struct Nobody {};

/// Random lines, slabs and plans around a place at a distance from the origin.
template <int Dim>
class Things {
 public:
  Things(noli::test::Random& random, double offset) : random_(random), offset_(offset) {}

  double signed_unit() { return 2 * random_.unit() - 1; }
  Vector<Dim> vector() {
    Vector<Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = signed_unit();
    return v;
  }
  Line<Dim> line() { return {vector() + Vector<Dim>::Constant(offset_), random_.unit(), vector()}; }

  /// A slab beside a line, moving roughly with it, so that the line reaches it unless it leads away.
  Slab<Dim> slab(const Line<Dim>& line, bool of_a) {
    Slab<Dim> slab;
    const Vector<Dim> n = vector();
    slab.normal = direction<Dim>(n, std::sqrt(n.squaredNorm()));
    slab.since = line.t;
    slab.half = 0.01 * random_.unit();
    const double side = of_a ? 1 : -1;
    slab.offset = slab.normal.dot(line.x) - side * (slab.half + random_.unit());
    slab.rate = slab.normal.dot(line.v) + signed_unit();
    return slab;
  }

 private:
  noli::test::Random& random_;
  double offset_;
};

/// Tests decisions where they are hardest: at the ends of plans and of what they hold.
template <int Dim>
void expect_ends_to_the_ulp(double offset) {
  noli::test::Random random(11);
  Things<Dim> things(random, offset);
  Nobody nobody;
  Decisions<Dim, Nobody> decisions(nobody);
  int walls = 0, balls = 0;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    const Line<Dim> line = things.line(), other = things.line();
    decisions.reach_out(line, 1e3);
    decisions.reach_out(other, 1e3);
    const bool of_a = random.below(2) == 0;
    const Slab<Dim> slab = things.slab(line, of_a);
    Plan<Dim> plan{line, random.below(2) == 0 ? 0 : 0.5 * random.unit(), 0};
    const double end =
        failure_time(ray_of<Dim>(line), wall_of<Dim>(slab, of_a, plan.radius + decisions.recording()), line.t);
    if (end > line.t && end < 1e3) {
      ++walls;
      plan.until = end;
      ASSERT_TRUE(decisions.stays_beyond(plan, slab, of_a, line.t));
      plan.until = std::nextafter(end, for_ever);
      ASSERT_FALSE(decisions.stays_beyond(plan, slab, of_a, line.t));
    }
    const Plan<Dim> ball{{line.x + 0.1 * things.vector(), line.t, other.v}, 0.1 + random.unit(), 1e3};
    const double out = failure_time(ray_of<Dim>(line), MovingBall<Dim>{ray_of<Dim>(ball.line), ball.radius}, line.t);
    if (out > line.t && out < 1e3) {
      ++balls;
      ASSERT_TRUE(decisions.holds(ball, line, out));
      ASSERT_FALSE(decisions.holds(ball, line, std::nextafter(out, for_ever)));
    }
  }
  EXPECT_GT(walls, 500);
  EXPECT_GT(balls, 500);
}

TEST(Decisions, AreRightToTheUlp) {
  for (const double offset : {0.0, 1e3, 1e9}) {
    SCOPED_TRACE(offset);
    expect_ends_to_the_ulp<2>(offset);
    expect_ends_to_the_ulp<3>(offset);
  }
}

TEST(Decisions, NothingHoldsBehindAPlansEndOrOutOfTheRangeOfNumbers) {
  Nobody nobody;
  Decisions<2, Nobody> decisions(nobody);
  const Plan<2> plan{{{0, 0}, 0, {1, 0}}, 1, 2};
  EXPECT_TRUE(decisions.holds(plan, plan.line, 2));
  EXPECT_FALSE(decisions.holds(plan, plan.line, 3));
  EXPECT_FALSE(decisions.holds(plan, {{0, 0}, 0, {for_ever, 0}}, 1));
  EXPECT_FALSE(decisions.holds(plan, {{std::nan(""), 0}, 0, {1, 0}}, 1));
}

struct Checked {
  std::uint64_t decisions = 0, wrong = 0;
};

template <int Dim, template <int, class> class Certificates>
void check(const KickOptions& options, Checked& sum) {
  RandomKicks<Dim, Certificates, true> scene(options);
  while (scene.kicks() < 100) {
    scene.run_window();
    scene.replay();
  }
  sum.decisions += scene.decisions();
  sum.wrong += scene.wrong_decisions();
}

template <template <int, class> class Certificates>
Checked check_all(Fault fault) {
  Checked sum;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    KickOptions options;
    options.seed = seed;
    options.bodies = 3;
    options.offset = seed % 3 == 0 ? 0 : seed % 3 == 1 ? 1e3 : 0x1p32;
    options.start = seed % 2 == 0 ? 0 : 1e8;
    options.fault = fault;
    seed < 3 ? check<3, Certificates>(options, sum) : check<2, Certificates>(options, sum);
  }
  return sum;
}

TEST(Decisions, OfRandomKicksAreThoseOfTheRationals) {
  const Checked cells = check_all<Cells>(Fault::none), literal = check_all<EveryPair>(Fault::none);
  EXPECT_EQ(cells.wrong, 0U);
  EXPECT_EQ(literal.wrong, 0U);
  EXPECT_GT(cells.decisions, 5'000U);
  EXPECT_GT(literal.decisions, 5'000U);
}

TEST(Decisions, OfTheLiteralAlgorithmWouldBeWrongAnUlpLater) {
  const Checked literal = check_all<EveryPair>(Fault::ulp_late);
  EXPECT_GT(4 * literal.wrong, literal.decisions) << "some never fail, and of a pair only the first to fail is asked";
}

}  // namespace
}  // namespace noli::certificates
