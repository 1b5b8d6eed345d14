// SPDX-License-Identifier: Apache-2.0
//
// Tests edges that turn through parallel, where their closest points jump (docs/contact.md, 2; certificates/closest.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact_models.h"
#include "integrator/contact_impulse.h"
#include "running.h"

namespace noli::integrator {
namespace {

using Points = std::array<Vec<double, 3>, 4>;

/// An edge of length 1 above one of length 2, tilted by `angle` in their common plane, with its middle at `height`.
Points tilted(double angle, double height) {
  const Vec<double, 3> half(0.5 * std::cos(angle), 0, 0.5 * std::sin(angle)), middle(0, 0, height);
  return {middle - half, middle + half, Vec<double, 3>(-1, 0, 0), Vec<double, 3>(1, 0, 0)};
}

certificates::Closest<3> closest(const Points& x) {
  return certificates::closest<3>(FeaturePair::edge_edge, std::span<const Vec<double, 3>>(x));
}

/// At the turn, the kick moves from one end over the middle to the other, and its size stays the same.
TEST(ParallelEdges, TheKickJumpsFromEndToEndAndIsNoLarger) {
  constexpr double height = 0.06, push = 2;
  for (const double angle : {-0.1, -1e-3, -2e-6, -1e-7, 0.0, 1e-7, 2e-6, 1e-3, 0.1}) {
    const auto c = closest(tilted(angle, height));
    const double middle_share = std::abs(angle) > 1e-6 ? (angle > 0 ? 0 : 1) : 0.5;
    EXPECT_NEAR(c.weights[1], middle_share, 1e-9) << angle;
    const double lower_end = height - 0.5 * std::sin(std::abs(angle));
    EXPECT_NEAR(c.distance(), lower_end, 0.5e-6 + 1e-12)
        << "the distance jumps by no more than half of a millionth of the edge";
    const Impulses<3> impulses = normal_impulses(c, c.distance(), push);
    EXPECT_NEAR((impulses[0] + impulses[1]).norm(), push, 1e-12);
    for (const auto& impulse : impulses) EXPECT_LE(impulse.norm(), push * (1 + 1e-15));
  }
}

constexpr double eta = 0.1, stiffness = 1000, speed = 3;

/// A rotating bar of two vertices without a spring falls onto a pinned one. The bars become parallel at about the time
/// when the layers stop it. `yaw`: the angle between them seen from above.
Model<double, 3> falling_bar(double yaw, double c, std::uint64_t draw) {
  Model<double, 3> model;
  const double height = 0.2 + 0.01 * (1 + test::noise(draw)), turning = 1 + 0.5 * test::noise(draw + 4000);
  const double along = 0.5 * std::cos(yaw), across = 0.5 * std::sin(yaw), tilt = turning * height / speed;
  const double slide = 0.2 * test::noise(draw + 8000);
  model.mesh.vertex_count = 4;
  model.mesh.edges = {{0, 1}, {2, 3}};
  model.x = {{slide - along, -across, height + 0.5 * tilt},
             {slide + along, across, height - 0.5 * tilt},
             {-1, 0, 0},
             {1, 0, 0}};
  model.v = {{0, 0, -speed - 0.5 * turning}, {0, 0, -speed + 0.5 * turning}, {0, 0, 0}, {0, 0, 0}};
  model.mass = {0.5, 0.5, 1, 1};
  model.pinned = {2, 3};
  model.window_length = 0.01;
  return test::with_contact(std::move(model), {eta, stiffness, c, 1, 0});
}

/// The relative change of energy by the impact, and how often the bar turned through level while layers acted, as seen
/// at ends of windows.
struct Impact {
  double error = 0;
  int turns = 0;
};

Impact impact(const Model<double, 3>& model) {
  Simulation<double, 3> simulation(model);
  const double start = simulation.state().kinetic;
  Impact result;
  double tilt = 0;
  for (int w = 0; w < 200; ++w) {
    test::run(simulation, 1);
    const auto s = simulation.snapshot();
    const double now = s.x[1][2] - s.x[0][2];
    const auto state = simulation.state();
    if (state.potential_sum() > 0 && tilt * now < 0) ++result.turns;
    tilt = now;
    if (s.x[0][2] > eta && s.x[1][2] > eta && s.v[0][2] > 0 && s.v[1][2] > 0) {
      result.error = state.kinetic / start - 1;
      return result;
    }
  }
  ADD_FAILURE() << "it does not come back";
  return result;
}

struct Spread {
  double mean = 0, deviation = 0;
  int turns = 0;
};

Spread errors(double yaw, double c) {
  constexpr int count = 1000;
  double sum = 0, squares = 0;
  Spread spread;
  for (int i = 0; i < count; ++i) {
    const Impact one = impact(falling_bar(yaw, c, static_cast<std::uint64_t>(i)));
    sum += one.error;
    squares += one.error * one.error;
    spread.turns += one.turns;
  }
  spread.mean = sum / count;
  spread.deviation = std::sqrt(squares / count - spread.mean * spread.mean);
  std::printf("yaw %g, c %g: mean %.2g, sd %.2g, %d turns through parallel\n", yaw, c, spread.mean, spread.deviation,
              spread.turns);
  return spread;
}

/// As documented in certificates/closest.h, the error has no bias. It is of first order in the step if edges turn
/// through parallel above each other, and of second order if not.
TEST(ParallelEdges, EnergyErrorIsAsDocumented) {
  for (const double c : {0.02, 0.05, 0.1}) {
    const Spread parallel = errors(0, c), crossing = errors(0.7, c);
    EXPECT_GT(parallel.turns, 500);
    EXPECT_NEAR(parallel.deviation, 0.2 * c, 0.15 * 0.2 * c);
    EXPECT_LT(std::abs(parallel.mean), 3 * parallel.deviation / std::sqrt(1000.0));
    EXPECT_EQ(crossing.turns, 0);
    EXPECT_LT(crossing.deviation, 0.1 * c * c);
    EXPECT_LT(errors(0.1, c).deviation, 0.1 * c * c) << "a tenth of a radian is enough";
  }
}

}  // namespace
}  // namespace noli::integrator
