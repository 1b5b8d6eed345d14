// SPDX-License-Identifier: Apache-2.0
//
// Compares the floating-point test of a direction, and the search for one, with rational arithmetic.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "proofs/prover/cells/around.h"
#include "proofs/prover/cells/direction_search.h"
#include "scenes.h"

namespace noli::testing {
namespace {

/// A face whose vertices are kept until the program ends.
template <int Dim>
StepCell<Dim> step_cell(const std::array<Position, 3>& x_t0, const std::array<Position, 3>& x_t1) {
  static std::deque<std::array<MovingVertex<Dim>, 3>> kept;
  auto& vertices = kept.emplace_back();
  for (std::size_t i = 0; i < 3; ++i) vertices[i] = moving_vertex<Dim>(x_t0[i], x_t1[i]);
  Mesh mesh;
  mesh.vertex_count = 3;
  mesh.faces = {{0, 1, 2}};
  return {indices_of(mesh, find_owners(mesh, false), 0), vertices.data()};
}

template <int Dim>
MovingCell<Dim> cell(const std::array<Position, 3>& x_t0, const std::array<Position, 3>& x_t1) {
  return gather(step_cell<Dim>(x_t0, x_t1));
}

template <int Dim>
PartPair<Dim> whole(const MovingCell<Dim>& a, const MovingCell<Dim>& b) {
  return pair_of(a, 7, b, 7, 0);
}

/// Coordinates of points.
using Points = std::vector<std::vector<mpq_class>>;

/// Whether n.(p - q) > 0, exactly, for all p of one list and all q of another.
template <int Dim>
bool truly_above(const Points& above, const Points& below, const Direction<Dim>& n) {
  return std::ranges::all_of(above, [&](const auto& p) {
    return std::ranges::all_of(below, [&](const auto& q) {
      mpq_class sum = 0;
      for (std::size_t k = 0; k < Dim; ++k) sum += n[k] * (p[k] - q[k]);
      return sum > 0;
    });
  });
}

/// The corners at time s.
template <int Dim>
Points corners_at(const MovingCell<Dim>& cell, double s) {
  Points points(3);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < Dim; ++k) {
      points[i].push_back((1 - mpq_class(s)) * cell.x[0][k][i] + s * mpq_class(cell.x[1][k][i]));
    }
  }
  return points;
}

/// Whether n.(a - b) > 0 at time s for all corners, exactly.
template <int Dim>
bool truly_above(const MovingCell<Dim>& a, const MovingCell<Dim>& b, const Direction<Dim>& n, double s) {
  return truly_above<Dim>(corners_at(a, s), corners_at(b, s), n);
}

template <int Dim>
std::array<double, Dim> negative(Direction<Dim> n) {
  for (double& c : n) c = -c;
  return n;
}

MovingCell<3> random_cell(Random& random, double size, double offset, double lift) {
  const auto point = [&] {
    return Position{offset + size * random.unit(), offset + size * random.unit(), offset + size * random.unit() + lift};
  };
  return cell<3>({point(), point(), point()}, {point(), point(), point()});
}

struct Scale {
  double size, offset;

  bool squares_fit() const { return size > 1e-160 && size < 1e160; }
};

class Separation : public ::testing::TestWithParam<Scale> {};
INSTANTIATE_TEST_SUITE_P(Scales, Separation,
                         ::testing::Values(Scale{1, 0}, Scale{1, 1e6}, Scale{1e-9, 1}, Scale{1e150, 0}, Scale{1e300, 0},
                                           Scale{1e-150, 0}, Scale{1e-300, 0}, Scale{1e308, 0}, Scale{1e-310, 0}));

TEST_P(Separation, IsNeverClaimedWrongly) {
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const double lift = GetParam().size * random.unit() * 2;
    const auto a = random_cell(random, GetParam().size, GetParam().offset, lift);
    const auto b = random_cell(random, GetParam().size, GetParam().offset, 0);
    const Interval interval = i % 2 == 0 ? Interval{0, 1} : Interval{0.25, 0.375};
    const std::array<double, 3> n = {random.unit() * 0.1, random.unit() * 0.1, 1};
    const int sign = separates(whole(a, b), n, interval);
    if (sign == 0) continue;
    const auto up = sign > 0 ? n : negative<3>(n);
    EXPECT_TRUE(truly_above(a, b, up, interval.begin) && truly_above(a, b, up, interval.end));
  }
}

TEST_P(Separation, ThatIsFoundHolds) {
  Random random(2);
  int found = 0, not_found = 0;
  for (int i = 0; i < 2000; ++i) {
    const double lift = GetParam().size * (1.5 + random.unit());
    const auto a = random_cell(random, GetParam().size, GetParam().offset, lift);
    const auto b = random_cell(random, GetParam().size, GetParam().offset, 0);
    const Interval interval = i % 2 == 0 ? Interval{0, 1} : Interval{0.25, 0.375};
    const auto n = find_direction(whole(a, b), {0, 0, GetParam().size}, interval, 10);
    ++(n ? found : not_found);
    if (!n) continue;
    EXPECT_TRUE(truly_above(a, b, *n, interval.begin) && truly_above(a, b, *n, interval.end));
  }
  EXPECT_GT(not_found, 0);
  EXPECT_EQ(found > 0, GetParam().squares_fit());
}

/// Two horizontal triangles, `gap` apart.
std::pair<MovingCell<3>, MovingCell<3>> stacked(double gap) {
  const std::array<Position, 3> low = {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
  std::array<Position, 3> high = low;
  for (Position& x : high) x[2] += gap;
  return {cell<3>(high, high), cell<3>(low, low)};
}

TEST(Direction, DoesNotSeparateWhatTouches) {
  const auto [high, low] = stacked(0);
  EXPECT_EQ(separates(whole(high, low), {0, 0, 1}), 0);
  EXPECT_FALSE(find_direction(whole(high, low), {0, 0, 1}, {0, 1}, 10));
}

TEST(Direction, SeparatesEitherWayWhatIsApart) {
  const auto [high, low] = stacked(0.001);
  EXPECT_EQ(separates(whole(high, low), {0, 0, 1}), 1);
  EXPECT_EQ(separates(whole(high, low), {0, 0, -1}), -1);
  EXPECT_EQ(separates(whole(high, low), {1, 0, 0}), 0);
  EXPECT_TRUE(find_direction(whole(high, low), {1, 0, 0}, {0, 1}, 10));
}

TEST(Direction, IsSilentWhenTheGapDrownsInTheErrorBound) {
  const auto [high, low] = stacked(0x1p-52);
  EXPECT_EQ(separates(whole(high, low), {0, 0, 1}), 0);
}

TEST(Direction, IsSilentWhenSomethingOverflowsOrIsNoNumber) {
  const auto [high, low] = stacked(1);
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {inf, -inf, nan, std::numeric_limits<double>::max()}) {
    EXPECT_EQ(separates(whole(high, low), {0, 0, bad}), 0);
    EXPECT_EQ(separates(whole(high, low), {bad, 0, 1}), 0);
  }
  EXPECT_EQ(separates(whole(high, low), {0, 0, 0}), 0);
}

TEST(Direction, MayHoldOverAPartOfTheStepOnly) {
  const std::array<Position, 3> low = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const std::array<Position, 3> above = {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
                                below = {{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}};
  const auto a = cell<3>(above, below), b = cell<3>(low, low);
  EXPECT_EQ(separates(whole(a, b), {0, 0, 1}), 0);
  EXPECT_EQ(separates(whole(a, b), {0, 0, 1}, {0, 0.375}), 1);
  EXPECT_EQ(separates(whole(a, b), {0, 0, 1}, {0.625, 1}), -1);
  EXPECT_FALSE(find_direction(whole(a, b), {0, 0, 1}, {0, 1}, 20));
  EXPECT_TRUE(find_direction(whole(a, b), {0, 0, -1}, {0, 0.375}, 20));
}

TEST(Direction, IsFoundIn2D) {
  const std::array<Position, 3> x = {{{0, 0, 9}, {1, 0, 9}, {0, 1, 9}}}, y = {{{1, 1, 9}, {2, 1, 9}, {1, 2, 9}}};
  const auto a = cell<2>(x, x), b = cell<2>(y, y);
  const auto n = find_direction(whole(a, b), {1, -1}, {0, 1}, 10);
  ASSERT_TRUE(n);
  EXPECT_TRUE(truly_above(a, b, *n, 0));
  EXPECT_FALSE(find_direction(whole(a, a), {1, -1}, {0, 1}, 10));
}

TEST(Direction, APartIsJustItsCorners) {
  const std::array<Position, 3> x = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, y = {{{0, 0, 2}, {1, 0, 2}, {0, 1, -2}}};
  const auto a = cell<3>(y, y), b = cell<3>(x, x);
  EXPECT_EQ(separates(pair_of(a, 7, b, 7, 0), {0, 0, 1}), 0);
  EXPECT_EQ(separates(pair_of(a, 3, b, 7, 0), {0, 0, 1}), 1);
  EXPECT_EQ(separates(pair_of(a, 4, b, 7, 2), {0, 0, 1}), -1);
}

/// The corners of two faces around the first corner of a.
PointsAround<3, 5> all_around(const StepCell<3>& a, const StepCell<3>& b) {
  return points_around<3, 2, 3>(a, b, 0, {1, 2}, {0, 1, 2});
}

std::array<Position, 3> random_face(Random& random, double size, double lift) {
  std::array<Position, 3> x;
  for (Position& p : x) p = {size * random.unit(), size * random.unit(), size * random.unit() + lift};
  return x;
}

TEST_P(Separation, AroundACornerIsNeverClaimedWrongly) {
  Random random(3);
  int claims = 0, silences = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = GetParam().size, lift = size * random.unit() * 2;
    const auto a = step_cell<3>(random_face(random, size, lift), random_face(random, size, lift));
    const auto b = step_cell<3>(random_face(random, size, 0), random_face(random, size, 0));
    const std::array<double, 3> n = {random.unit() * 0.1, random.unit() * 0.1, 1};
    const int sign = separates(all_around(a, b), n);
    ++(sign != 0 ? claims : silences);
    if (sign == 0) continue;
    const auto up = sign > 0 ? n : negative<3>(n);
    EXPECT_TRUE(truly_above(gather(a), gather(b), up, 0) && truly_above(gather(a), gather(b), up, 1));
  }
  EXPECT_GT(silences, 0);
  const bool in_range = GetParam().size > 1e-308 && GetParam().size < 1e308;
  EXPECT_EQ(claims > 0, in_range);
}

TEST(Around, SeparatesEitherWayWhatIsApart) {
  const std::array<Position, 3> low = {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}, high = {{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}};
  const auto a = step_cell<3>(high, high), b = step_cell<3>(low, low);
  EXPECT_EQ(separates(all_around(a, b), {0, 0, 1}), 1);
  EXPECT_EQ(separates(all_around(b, a), {0, 0, 1}), -1);
  EXPECT_EQ(separates(all_around(a, b), {1, 0, 0}), 0);
  EXPECT_EQ(separates(all_around(a, a), {0, 0, 1}), 0);
  EXPECT_EQ(separates(all_around(a, b), between_middles(all_around(a, b))), 1);
  EXPECT_EQ(separates(all_around(a, b), mid_normal(a.x(0), a.x(1), a.x(2))), 1);
}

TEST(Around, ADirectionMustHoldAtBothEnds) {
  const std::array<Position, 3> low = {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}, high = {{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}};
  EXPECT_EQ(separates(all_around(step_cell<3>(high, low), step_cell<3>(low, high)), {0, 0, 1}), 0);
  EXPECT_EQ(separates(all_around(step_cell<3>(high, low), step_cell<3>(low, low)), {0, 0, 1}), 0);
}

TEST(Around, ACornerIsBetweenItsFacesOrNot) {
  const std::array<Position, 3> x = {{{0, 0, 0}, {2, -1, 0}, {2, 1, 0}}}, y = {{{0, 0, 0}, {-2, 1, 0}, {-2, -1, 1}}};
  const auto a = step_cell<3>(x, x), b = step_cell<3>(y, y);
  EXPECT_TRUE(around_corner(points_around<3, 2, 2>(a, b, 0, {1, 2}, {1, 2})));
  EXPECT_FALSE(around_corner(points_around<3, 2, 2>(a, a, 0, {1, 2}, {1, 2})));
}

TEST(Around, AFlatHingeIsSettledAndAFoldedOneIsNot) {
  const std::array<Position, 3> x = {{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, y = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}}};
  const auto a = step_cell<3>(x, x), b = step_cell<3>(y, y);
  const auto flat = around_edge(points_around<3, 2, 1>(a, b, 0, {1, 2}, {2}));
  EXPECT_EQ(flat.found, (std::array<bool, 4>{true, true, true, true}));
  const auto folded = around_edge(points_around<3, 2, 1>(a, a, 0, {1, 2}, {2}));
  EXPECT_EQ(folded.found, (std::array<bool, 4>{false, false, false, false}));
}

/// Expects that usual directions settle all pairs of faces around a vertex of a flat grid of right triangles.
template <int Dim>
void expect_settled_around_a_vertex(double stretch) {
  const std::array<std::array<double, 2>, 6> ring = {{{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}};
  const auto face = [&](std::size_t i, bool turned) {
    std::array<Position, 3> x = {};
    for (std::size_t k = 1; k < 3; ++k) x[k] = {ring[(i + k - 1) % 6][0], stretch * ring[(i + k - 1) % 6][1], 0};
    if (turned) std::swap(x[1], x[2]);
    return step_cell<Dim>(x, x);
  };
  int second = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    SCOPED_TRACE(::testing::Message() << "stretch " << stretch << ", face " << i);
    const auto hinge = around_edge(points_around<Dim, 2, 1>(face(i, true), face(i + 1, false), 0, {1, 2}, {2}));
    EXPECT_EQ(hinge.found, (std::array<bool, 4>{true, true, true, true}));
    for (const std::size_t apart : {2UL, 3UL}) {
      const auto points = points_around<Dim, 2, 2>(face(i, false), face(i + apart, false), 0, {1, 2}, {1, 2});
      EXPECT_TRUE(around_corner(points));
      if (!separates_corner(points, between_middles(points))) ++second;
    }
  }
  EXPECT_GT(second, 0) << "the second direction was never needed";
}

TEST(Around, UsualDirectionsSettleAllFacesAroundAVertexOfAGrid) {
  for (const double stretch : {1.0, 0.3, 3.0}) {
    expect_settled_around_a_vertex<3>(stretch);
    expect_settled_around_a_vertex<2>(stretch);
  }
}

TEST(Around, FlatHingesAreSettledWhateverTheirAngles) {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Position a = {0, 0, 0}, b = {1, 0, 0};
    const Position c = {0.5 + 3 * random.unit(), 1.1 + random.unit(), 0};
    const Position d = {0.5 + 3 * random.unit(), -1.1 + random.unit(), 0};
    const auto around = around_edge(
        points_around<3, 2, 1>(step_cell<3>({a, b, c}, {a, b, c}), step_cell<3>({a, b, d}, {a, b, d}), 0, {1, 2}, {2}));
    EXPECT_EQ(around.found, (std::array<bool, 4>{true, true, true, true})) << c[0] << ' ' << c[1] << ", " << d[0];
  }
}

/// Five points near those of two flat faces around their first corner, (0, 1, 2) and (0, 3, 4), at both ends.
std::array<std::array<Position, 5>, 2> random_fan(Random& random, const Scale& scale) {
  std::array<std::array<Position, 5>, 2> x = {};
  double angle = 0;
  for (std::size_t i = 1; i < 5; ++i) {
    angle += 0.9 + 0.7 * random.unit();
    const double length = 0.6 + 0.5 * random.unit();
    x[0][i] = {length * std::cos(angle), length * std::sin(angle), 0};
  }
  x[1] = x[0];
  for (auto& at_end : x) {
    for (Position& p : at_end) {
      for (double& c : p) c = scale.offset + scale.size * (c + 0.2 * random.unit());
    }
  }
  return x;
}

Points exactly(const std::vector<Position>& points) {
  Points result;
  for (const Position& p : points) result.emplace_back(p.begin(), p.end());
  return result;
}

TEST_P(Separation, WhatIsClaimedOfACornerHolds) {
  Random random(4);
  int claims = 0, silences = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto x = random_fan(random, GetParam());
    const auto face = [&](std::size_t b, std::size_t c) {
      return step_cell<3>({x[0][0], x[0][b], x[0][c]}, {x[1][0], x[1][b], x[1][c]});
    };
    const auto n = around_corner(points_around<3, 2, 2>(face(1, 2), face(3, 4), 0, {1, 2}, {1, 2}));
    ++(n ? claims : silences);
    if (!n) continue;
    for (const auto& [a, b, c, d, e] : x) {
      EXPECT_TRUE(truly_above<3>(exactly({b, c}), exactly({a, d, e}), *n));
      EXPECT_TRUE(truly_above<3>(exactly({a, b, c}), exactly({d, e}), *n));
    }
  }
  EXPECT_GT(silences, 0);
  EXPECT_EQ(claims > 0, GetParam().squares_fit());
}

TEST_P(Separation, WhatIsClaimedOfAnEdgeHolds) {
  Random random(5);
  std::array<int, 4> claims = {}, silences = {};
  for (int i = 0; i < 1000; ++i) {
    const auto x = random_fan(random, GetParam());  // points 1 and 3 are on either side of the edge from 0 to 2
    const auto a = step_cell<3>({x[0][0], x[0][2], x[0][1]}, {x[1][0], x[1][2], x[1][1]});
    const auto b = step_cell<3>({x[0][0], x[0][2], x[0][3]}, {x[1][0], x[1][2], x[1][3]});
    const auto around = around_edge(points_around<3, 2, 1>(a, b, 0, {1, 2}, {2}));
    for (std::size_t k = 0; k < 4; ++k) ++(around.found[k] ? claims : silences)[k];
    for (const auto& [p, c, q, d, unused] : x) {  // the edge is (p, q)
      const std::array<std::array<Points, 2>, 4> parts = {{{exactly({c}), exactly({p, q, d})},
                                                           {exactly({q, c}), exactly({p, d})},
                                                           {exactly({p, c}), exactly({q, d})},
                                                           {exactly({p, q, c}), exactly({d})}}};
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_TRUE(!around.found[k] || truly_above<3>(parts[k][0], parts[k][1], around.n[k])) << k;
      }
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GT(silences[k], 0) << k;
    EXPECT_EQ(claims[k] > 0, GetParam().squares_fit()) << k;
  }
}

}  // namespace
}  // namespace noli::testing
