// SPDX-License-Identifier: Apache-2.0
//
// Tests when gravity acts, and the effect of its steps on energy.
#include "integrator/falling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "contact_models.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "models.h"
#include "running.h"

namespace noli::integrator {
namespace {

using test::noise;
using test::run;

constexpr double g = 9.81;

/// A shaking sheet with estimated steps.
Model<double, 3> shaking_sheet(Clocks clocks) {
  Model<double, 3> model = test::sheet({});
  model.pinned = {0, 6};
  model.clocks = clocks;
  test::choose_steps(model, 0.5);
  return model;
}

std::size_t breakpoints(const Model<double, 3>& model) {
  Simulation<double, 3> simulation(model);
  Recording<double, 3> recording;
  Books<double, 3> books;
  for (int w = 0; w < 3; ++w) simulation.run_window(recording, books);
  return recording.stream().size();
}

TEST(Falling, RidesOnTheForcesOfAVertex) {
  for (const Clocks clocks : {Clocks::grouped, Clocks::own}) {
    Model<double, 3> model = shaking_sheet(clocks);
    const std::size_t without = breakpoints(model);
    model.gravity = Gravity<double, 3>{{0, 0, -g}, model.window_length};
    EXPECT_EQ(breakpoints(model), without);
    model.gravity->step = 1e-4;  // shorter than the forces' steps
    EXPECT_GT(breakpoints(model), 3 * without);
  }
}

/// A pair whose spring is at rest but determines when gravity acts. Windows do not end at steps.
Model<double, 2> falling_pair(Clocks clocks, double step) {
  Model<double, 2> model = test::spring_pair<2>(1, 3, 100, 0, 0.0137);
  model.v.assign(2, Vec<double, 2>(1, 2));
  model.window_length = 0.05;
  model.clocks = clocks;
  model.gravity = Gravity<double, 2>{{0, -g}, step};
  return model;
}

TEST(Falling, IsOnItsParabolaAtTheEndsOfWindowsWhateverTheSteps) {
  for (const Clocks clocks : {Clocks::grouped, Clocks::own}) {
    for (const double step : {0.05, 0.011}) {
      Simulation<double, 2> simulation(falling_pair(clocks, step));
      for (int w = 0; w < 40; ++w) {
        run(simulation, 1);
        const double t = simulation.time();
        const auto x = simulation.snapshot().x;
        const auto v = simulation.mean_velocities();
        EXPECT_NEAR(x[0][1], 2 * t - g / 2 * t * t, 1e-12) << t;
        EXPECT_NEAR(x[1][0], 1 + t, 1e-12);
        EXPECT_NEAR(v[1][1], 2 - g * t, 1e-12);
      }
    }
  }
}

/// A window that ends early cuts a step p after s; each time, falling vertices end up g s (p - s) / 2 too low.
TEST(Falling, AnEarlyEndCostsLessThanItsStepSquared) {
  Model<double, 2> model = falling_pair(Clocks::own, 0.05);
  model.most_breakpoints = 7;
  Simulation<double, 2> simulation(model);
  Recording<double, 2> recording;
  Books<double, 2> books;
  int early = 0;
  for (int w = 0; w < 40; ++w) {
    recording.clear();
    simulation.run_window(recording, books);
    const double t = simulation.time(), windows = t / 0.05;
    early += windows != std::round(windows) ? 1 : 0;
    const double high = simulation.snapshot().x[0][1] - (2 * t - g / 2 * t * t);
    EXPECT_LE(high, 1e-12);
    EXPECT_GE(high, -g * 0.0137 * 0.0137 / 8 * early - 1e-12 - t * 1e-12);
    EXPECT_NEAR(simulation.mean_velocities()[0][1], 2 - g * t, 1e-12);
  }
  EXPECT_GT(early, 5);
}

TEST(Falling, GoesOnFromASnapshotBitForBit) {
  for (const Clocks clocks : {Clocks::grouped, Clocks::own}) {
    Model<double, 3> model = shaking_sheet(clocks);
    model.gravity = Gravity<double, 3>{{0, 0, -g}, 0.7 * model.window_length};
    Simulation<double, 3> whole(model);
    run(whole, 3);
    Simulation<double, 3> resumed(model, whole.snapshot());
    run(whole, 4);
    run(resumed, 4);
    test::expect_same(whole.snapshot(), resumed.snapshot());
  }
}

// --- With contact ----------------------------------------------------------------------------------------------------

constexpr double ball_thickness = 0.01, ball_stiffness = 1e7, layer_step = 0x1p-20;

/// A ball of mass 1 above a floor. Layers are stiff and their steps so short that the remaining error is gravity's.
Model<double, 2> stiff_ball(double height, double speed, double step) {
  Model<double, 2> model = test::with_contact(test::ball_and_floor(height, speed),
                                              {ball_thickness, ball_stiffness, 0.1, /*restitution=*/1, 0});
  model.contact->materials[0].step = layer_step;
  model.window_length = 0x1p-4;
  model.gravity = Gravity<double, 2>{{0, -g}, step};
  return model;
}

bool is_multiple(double t, double step) { return std::floor(t / step) * step == t; }

/// Gravity alone acts on the ball once per step. An impulse makes it act once more, at the next time of a first layer,
/// however deep the layer was.
TEST(Falling, ActsFinelyBehindImpulses) {
  const double step = 0x1p-7;
  Simulation<double, 2> simulation(stiff_ball(0.02, 1, step));
  Recording<double, 2> recording;
  Books<double, 2> books;
  simulation.run_window(recording, books);
  ASSERT_GT(books.of(ForceKind::contact).events, 100U);
  std::vector<double> times;
  for (const auto& b : recording.stream()) {
    if (b.vertex == 0 && b.t > 0) times.push_back(b.t);
  }
  std::size_t own = 0, with_first_layers = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (is_multiple(times[k], step)) {
      ++own;
    } else if (is_multiple(times[k], layer_step)) {
      ++with_first_layers;
    } else {
      ASSERT_LT(k + 1, times.size());
      EXPECT_LE(times[k + 1], std::ceil(times[k] / layer_step) * layer_step) << "an impulse of a deep layer";
    }
  }
  EXPECT_EQ(own, simulation.time() / step);
  EXPECT_GT(with_first_layers, 50U);
  EXPECT_TRUE(is_multiple(times.back(), step)) << "it has left";
}

/// The change of K + V by an impact, over m [J/kg].
struct Change {
  double mean = 0, error = 0;
};

/// The mean change for balls that fall from different heights, starting with 3 m/s.
Change change_by_an_impact(const Model<double, 2>& ball, int impacts) {
  double sum = 0, squares = 0;
  for (int i = 0; i < impacts; ++i) {
    Model<double, 2> model = ball;
    const double eta = model.contact->materials[0].thickness;
    model.x[0][1] = eta + 0.23 + 0.2 * noise(static_cast<std::uint64_t>(i));
    Simulation<double, 2> simulation(model);
    const double before = simulation.state().energy();
    const auto is_back = [&] { return simulation.mean_velocities()[0][1] > 0 && simulation.snapshot().x[0][1] > eta; };
    for (int w = 0; w < 8 && !is_back(); ++w) run(simulation, 1);
    EXPECT_TRUE(is_back()) << i;
    const double change = simulation.state().energy() - before;
    sum += change;
    squares += change * change;
  }
  const double mean = sum / impacts;
  return {mean, std::sqrt((squares / impacts - mean * mean) / impacts)};
}

/// Tests the formula derived in integrator/falling.h.
TEST(Falling, AnImpactCostsAboutATwelfthOfGravitysStepSquared) {
  const double step = 0x1p-6;  // the fall within a step is small against the spread of heights
  const Change change = change_by_an_impact(stiff_ball(0, 3, step), 2000);
  const double theory = -g * g * step * step / 12;
  std::printf("energy of an impact: %.3g J/kg (expected %.3g) +- %.2g\n", change.mean, theory, change.error);
  EXPECT_LT(change.error, -theory / 10);
  EXPECT_NEAR(change.mean, theory, 3 * change.error);
}

/// By default, layers are soft and their steps are not short compared with gravity's. An error of first order in h(1)
/// would be about m v g h(1) / 2.
TEST(Falling, AnImpactOnSoftLayersHasNoTrend) {
  Model<double, 2> model = stiff_ball(0, 3, 0x1p-9);
  model.contact->materials[0] = {0.1, 1000, 0.05 / std::sqrt(1000), 1, 0};
  const Change change = change_by_an_impact(model, 1000);
  const double first_order = 3 * g * model.contact->materials[0].step / 2;
  std::printf("energy of an impact: %.2g J/kg +- %.2g\n", change.mean, change.error);
  EXPECT_LT(change.error, first_order / 100);
  EXPECT_NEAR(change.mean, 0, 3 * change.error);
}

/// A body resting on layers stays in place. At a window's end gravity forgets that the body was struck, and the step
/// cut there throws it down by g h p / 2.
TEST(Falling, RestStaysRest) {
  const double h = 0x1p-10, step = 0x1p-7, part = 0x1p-5;
  Model<double, 2> model = stiff_ball((1 - part) * ball_thickness, 0, step);
  model.contact->materials[0] = {ball_thickness, g / (part * ball_thickness), h, 1, 0};
  Simulation<double, 2> simulation(model);
  Books<double, 2> books;
  double farthest = 0;
  for (int w = 0; w < 128; ++w) {
    books += run(simulation, 1);
    farthest = std::max(farthest, std::abs(simulation.snapshot().x[0][1] - model.x[0][1]));
  }
  const double throws = g * h * step / 2;
  std::printf("8 s at rest: at most %.2g of a throw away\n", farthest / throws);
  EXPECT_GT(farthest, 0.1 * throws);
  EXPECT_LT(farthest, 5 * throws);
  EXPECT_EQ(books.of(ForceKind::contact).events, 8 / h + 1) << "the first layer, each time and at the start";
}

/// A ring, points and a floor, with several contact stiffnesses and so several h(1). Windows end early during contact.
Model<double, 2> several_materials(const std::string& steps) {
  const std::string text = R"({
    "noli_scene": 1, "dimension": 2, "duration": 1, "window": 0.011, "gravity": [0.3, -9.8],
    "most_breakpoints": 150, "steps": ")" +
                           steps + R"(",
    "bodies": [
      {"name": "ring", "mesh": {"ring": {"radius": 0.05, "segments": 6}}, "velocity": [0.2, -1],
       "transform": {"translate": [0, 0.08]},
       "material": {"edge_stiffness": 300, "bending_stiffness": 0.001, "mass_per_vertex": 0.001}},
      {"name": "balls", "mesh": {"points": {"at": [[0, 0.16], [0.12, 0.03]]}}, "velocity": [0, -1],
       "material": {"edge_stiffness": 0, "mass_per_vertex": 0.002}},
      {"name": "floor", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}}, "pin": ["all"],
       "material": {"edge_stiffness": 0, "mass_per_length": 1}}],
    "contact": {"thickness": 0.01, "stiffness": 300, "restitution": 0.5, "friction": 0.3,
      "pairs": [{"bodies": ["balls", "floor"], "stiffness": 90}, {"bodies": ["balls", "ring"], "stiffness": 1000}]}})";
  return build_model<2>(parse_scene(text, "scene.json")).model;
}

TEST(Falling, GoesOnBitForBitWhereSeveralMaterialsStrike) {
  for (const char* const steps : {"grouped", "own"}) {
    const Model<double, 2> model = several_materials(steps);
    ASSERT_GE(model.contact->materials.size(), 3U);
    Simulation<double, 2> whole(model);
    Recording<double, 2> recording;
    Books<double, 2> books;
    int early = 0;
    for (int w = 0; w < 60; ++w) {
      const Snapshot<double, 2> before = whole.snapshot();
      recording.clear();
      whole.run_window(recording, books);
      const double windows = whole.time() / model.window_length;
      early += windows != std::round(windows) ? 1 : 0;
      if (w == 0) continue;
      Simulation<double, 2> resumed(model, before);
      recording.clear();
      Books<double, 2> again;
      resumed.run_window(recording, again);
      ASSERT_EQ(resumed.time(), whole.time());
      ASSERT_NO_FATAL_FAILURE(test::expect_same(whole.snapshot(), resumed.snapshot())) << steps << " " << w;
    }
    EXPECT_GT(early, 20);
    EXPECT_GT(books.of(ForceKind::contact).events, 500U);
  }
}

}  // namespace
}  // namespace noli::integrator
