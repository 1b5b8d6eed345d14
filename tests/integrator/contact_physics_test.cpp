// SPDX-License-Identifier: Apache-2.0
//
// Compares contact over many impacts with theory and with the tables of docs/contact.md, 1 and 4. contact_test.cpp
// covers its section 3.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact_models.h"
#include "running.h"

namespace noli::integrator {
namespace {

using test::ball_and_floor;
using test::with_contact;

constexpr double thickness = 0.1, stiffness = 1000;

/// A ball of mass 1 above an immovable floor, so 1 / m_eff = 1 / m and h(1) = c / sqrt(r(1)).
Model<double, 2> ball(double height, double speed, double c, double restitution = 1) {
  Model<double, 2> model =
      with_contact(ball_and_floor(height, speed), {thickness, stiffness, c, restitution, /*friction=*/0});
  model.contact->materials[0].step = c / std::sqrt(stiffness);
  return model;
}

/// The mean and the standard deviation of values.
struct Statistics {
  double mean, deviation;
};

Statistics statistics(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const double mean = sum / static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / static_cast<double>(values.size()))};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[values.size() / 2] + values[(values.size() - 1) / 2]);
}

// --- Restitution -----------------------------------------------------------------------------------------------------

/// Speed after an impact over speed before, once the ball has left the layers.
double speed_ratio(double height, double c, double restitution) {
  constexpr double speed = 3;
  Simulation<double, 2> simulation(ball(height, speed, c, restitution));
  for (int w = 0; w < 300; ++w) {
    test::run(simulation, 1);
    const auto s = simulation.snapshot();
    if (s.v[0][1] > 0 && s.x[0][1] > thickness) return s.v[0][1] / speed;
  }
  ADD_FAILURE() << "it does not come back";
  return 0;
}

double mean_speed_ratio(double c, double restitution) {
  std::vector<double> ratios;
  for (std::uint64_t i = 0; i < 1000; ++i)
    ratios.push_back(speed_ratio(0.2 + 0.01 * (1 + test::noise(i)), c, restitution));
  const Statistics s = statistics(ratios);
  std::printf("c %g, e %g: v ratio %.6f = sqrt(e) %+.3f %%, sd %.2g\n", c, restitution, s.mean,
              100 * (s.mean / std::sqrt(restitution) - 1), s.deviation);
  return s.mean;
}

/// docs/contact.md, 4.
TEST(ContactPhysics, AHundredthOfTheEnergyComesBack) {
  EXPECT_NEAR(mean_speed_ratio(0.05, 0.01), 0.1, 0.015 * 0.1);
  EXPECT_NEAR(mean_speed_ratio(0.02, 0.01), 0.1, 0.005 * 0.1);
}

TEST(ContactPhysics, AllOfTheEnergyComesBack) { EXPECT_NEAR(mean_speed_ratio(0.05, 1), 1, 0.005); }

// --- Energy ----------------------------------------------------------------------------------------------------------

/// Tests docs/contact.md, 3, and the energy accounts: contact's work is the change of the kinetic energy, window by
/// window. The impacts are oblique.
TEST(ContactPhysics, AThousandImpactsHaveNoTrendAndTheirBooksClose) {
  std::vector<double> changes;
  double worst = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Model<double, 2> model = ball(0.2 + 0.01 * (1 + test::noise(i + 5000)), 3, 0.05);
    model.v[0][0] = test::noise(i + 9000);
    Simulation<double, 2> simulation(model);
    const double start = simulation.state().kinetic;
    for (int w = 0; w < 30; ++w) {
      const double before = simulation.state().kinetic;
      const Books<double, 2> books = test::run(simulation, 1);
      worst = std::max(worst, std::abs(simulation.state().kinetic - before - books.work()) / start);
    }
    const auto s = simulation.snapshot();
    ASSERT_GT(s.x[0][1], thickness);
    changes.push_back(s.v[0][1] * s.v[0][1] / 9 - 1);
  }
  const Statistics s = statistics(changes);
  std::printf("energy of an impact: mean %.2g, sd %.2g; books: %.2g\n", s.mean, s.deviation, worst);
  EXPECT_LT(std::abs(s.mean), 3e-5);
  EXPECT_LT(s.deviation, 6e-4);
  EXPECT_LT(worst, 1e-10);
}

/// The least and the greatest energy, relative to the initial energy.
struct Range {
  double low = 1, high = 1;
};

/// docs/contact.md, 1: 1D ball, g = 9.8, about 227 bounces. Energy is measured outside of the layers. Gravity's step is
/// the window halved until it is at most h(1).
Range energy_range(double height, double c) {
  constexpr double g = 9.8, window = 0.05, duration = 200, many_times = 100;
  Model<double, 2> model = ball(height, 0, c);
  model.window_length = window;
  double step = window;
  while (step > model.contact->materials[0].step) step /= 2;
  model.gravity = Gravity<double, 2>{{0, -g}, step};
  Simulation<double, 2> simulation(model);
  Range range;
  for (int w = 0; w < std::lround(duration / window) && range.high < many_times; ++w) {
    test::run(simulation, 1);
    if (simulation.snapshot().x[0][1] < thickness) continue;
    const auto state = simulation.state();
    const double energy = (state.kinetic_mean + state.potential_sum()) / (g * height);
    range.low = std::min(range.low, energy);
    range.high = std::max(range.high, energy);
  }
  return range;
}

/// Medians over 32 heights.
Range median_range(double c) {
  std::vector<double> low, high;
  for (std::uint64_t i = 0; i < 32; ++i) {
    const Range range = energy_range(1 + 0.1 * test::noise(i), c);
    low.push_back(range.low);
    high.push_back(range.high);
  }
  const Range result{median(low), median(high)};
  std::printf("c %.2f: E/E0 %.4f .. %.4f\n", c, result.low, result.high);
  return result;
}

struct TableRow {
  double c, low, high;
};

/// Each line of the table is a single run, whose extremes are those of a random walk, so widths only agree within a
/// factor of three.
TEST(ContactPhysics, SlowEnergyOfABallThatBouncesAsInTheTable) {
  double width_before = 0;
  for (const TableRow row : {TableRow{0.02, 0.9998, 1.0014}, TableRow{0.05, 0.995, 1.011}, TableRow{0.1, 0.92, 1.001},
                             TableRow{0.2, 0.61, 1.05}}) {
    const Range range = median_range(row.c);
    const double width = range.high - range.low, table = row.high - row.low;
    EXPECT_GT(width, 2 * width_before);
    EXPECT_LT(width, 3 * table);
    EXPECT_GT(width, table / 3);
    width_before = width;
  }
  const Range growing = median_range(0.4);
  EXPECT_GT(growing.high, 4.1 / 2);
  EXPECT_LT(growing.high, 4.1 * 2);
  for (const double c : {0.7, 1.0}) EXPECT_GT(median_range(c).high, 100) << c;
}

}  // namespace
}  // namespace noli::integrator
