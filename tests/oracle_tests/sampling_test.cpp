// SPDX-License-Identifier: Apache-2.0
//
// Compares the oracle with brute force: at many times, decides whether the features meet by rational linear algebra,
// which shares no code with the oracle.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <random>
#include <vector>

#include "oracle/oracle.h"

namespace noli::oracle {
namespace {

using Rational = mpq_class;
using Row = std::vector<Rational>;

/// Solves sum w_i column_i = right for independent columns; nullopt if they are dependent or there is no solution.
std::optional<Row> solve(std::vector<Row> rows) {
  const std::size_t unknowns = rows[0].size() - 1;
  for (std::size_t column = 0; column < unknowns; ++column) {
    std::size_t pivot = column;
    while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
    if (pivot == rows.size()) return std::nullopt;
    std::swap(rows[pivot], rows[column]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == column || rows[i][column] == 0) continue;
      const Rational factor = rows[i][column] / rows[column][column];
      for (std::size_t j = column; j <= unknowns; ++j) rows[i][j] -= factor * rows[column][j];
    }
  }
  for (std::size_t i = unknowns; i < rows.size(); ++i) {
    if (rows[i][unknowns] != 0) return std::nullopt;
  }
  Row w;
  for (std::size_t i = 0; i < unknowns; ++i) w.push_back(rows[i][unknowns] / rows[i][i]);
  return w;
}

/// Whether some affinely independent points have 0 in their hull (Caratheodory).
bool hull_holds_zero(const std::vector<Row>& points) {
  for (unsigned subset = 1; subset < 1U << points.size(); ++subset) {
    if (std::popcount(subset) > 4) continue;
    std::vector<Row> rows(4);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((subset >> i & 1U) == 0) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) rows[axis].push_back(points[i][axis]);
      rows[3].push_back(1);
    }
    for (std::size_t i = 0; i < 4; ++i) rows[i].push_back(i == 3 ? 1 : 0);
    const auto w = solve(rows);
    if (w && std::all_of(w->begin(), w->end(), [](const Rational& x) { return x >= 0; })) return true;
  }
  return false;
}

bool meet_at(const Motion& motion, const Rational& t) {
  std::vector<Row> differences;
  for (std::size_t i = 0; i < first_count(motion.pair); ++i) {
    for (std::size_t j = first_count(motion.pair); j < point_count(motion.pair); ++j) {
      Row& d = differences.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Rational at_t0 = Rational(motion.x_t0[i][axis]) - Rational(motion.x_t0[j][axis]);
        const Rational at_t1 = Rational(motion.x_t1[i][axis]) - Rational(motion.x_t1[j][axis]);
        d.push_back((1 - t) * at_t0 + t * at_t1);
      }
    }
  }
  return hull_holds_zero(differences);
}

Motion random_motion(Pair pair, int dimension, std::mt19937_64& random) {
  Motion motion{pair, dimension, {}, {}};
  for (auto* points : {&motion.x_t0, &motion.x_t1}) {
    for (std::size_t i = 0; i < point_count(pair); ++i) {
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
        (*points)[i][axis] = static_cast<double>(random() % 5) - 2;
      }
    }
  }
  return motion;
}

/// Expects no contact at samples before the first time, and contact at the first time if it is a sample.
void check(const Motion& motion, const Answer& answer) {
  constexpr long steps = 60;
  for (long k = 0; k <= steps; ++k) {
    const Rational t(k, steps);
    const bool meets = meet_at(motion, t);
    if (!answer.time) {
      EXPECT_FALSE(meets) << k;
      continue;
    }
    const Polynomial sample({Integer(-k), Integer(steps)});
    const int side = answer.time->sign_of(sample);  // sign of first time - t
    EXPECT_FALSE(meets && side > 0) << "before the first time: " << k;
    EXPECT_FALSE(!meets && side == 0) << "at the first time: " << k;
  }
}

class Sampling : public testing::TestWithParam<std::pair<Pair, int>> {};

TEST_P(Sampling, NeverContradicts) {
  std::mt19937_64 random(11);
  const auto [pair, dimension] = GetParam();
  int contacts = 0, apart = 0;
  for (int i = 0; i < 150; ++i) {
    const Motion motion = random_motion(pair, dimension, random);
    const Answer answer = first_contact(motion);
    ++(answer.time ? contacts : apart);
    check(motion, answer);
    if (HasFailure()) return;
    if (answer.kind == Kind::persistent) {
      const Rational soon = Rational(answer.time->lower()) + Rational(1, 1 << 20);
      EXPECT_TRUE(meet_at(motion, soon));
    }
  }
  EXPECT_GT(apart, 10);
  EXPECT_GT(contacts, 0);
}

TEST_P(Sampling, WithinDistanceZeroIsContactAndMoreIsNoLater) {
  std::mt19937_64 random(12);
  const auto [pair, dimension] = GetParam();
  for (int i = 0; i < 60; ++i) {
    const Motion motion = random_motion(pair, dimension, random);
    const auto contact = first_contact(motion).time, none = first_within(motion, 0), some = first_within(motion, .75);
    ASSERT_EQ(contact.has_value(), none.has_value());
    if (!contact) continue;
    EXPECT_EQ(contact->compare(*none), 0);
    ASSERT_TRUE(some);
    EXPECT_LE(some->compare(*none), 0);
    EXPECT_EQ(some->compare(*none) == 0, none->compare(0.0) == 0)
        << "features that are not in contact are .75 apart first";
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, Sampling,
                         testing::Values(std::pair(Pair::vertex_face, 3), std::pair(Pair::edge_edge, 3),
                                         std::pair(Pair::vertex_edge, 3), std::pair(Pair::vertex_vertex, 3),
                                         std::pair(Pair::vertex_edge, 2), std::pair(Pair::vertex_vertex, 2)));

TEST(SamplingItself, TellsContactFromNone) {
  const Motion through{Pair::vertex_face,
                       3,
                       {{{.25, .25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                       {{{.25, .25, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  EXPECT_TRUE(meet_at(through, Rational(1, 2)));
  EXPECT_FALSE(meet_at(through, Rational(1, 3)));
}

}  // namespace
}  // namespace noli::oracle
