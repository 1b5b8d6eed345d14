// SPDX-License-Identifier: Apache-2.0
//
// Compares simulations over many periods with theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrator/engine.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "integrator/simulation.h"
#include "models.h"
#include "trajectory/text.h"

namespace noli::integrator {
namespace {

/// The frequency of a series around `middle`, from its upward crossings.
double frequency(const std::vector<double>& series, double middle, double interval) {
  std::vector<double> up;
  for (std::size_t k = 1; k < series.size(); ++k) {
    const double a = series[k - 1] - middle, b = series[k] - middle;
    if (a < 0 && b >= 0) up.push_back((static_cast<double>(k) - b / (b - a)) * interval);
  }
  return static_cast<double>(up.size() - 1) / (up.back() - up.front());
}

/// The frequency of the scene's beam with another number of segments. Its length starts at the middle of the clamped
/// segment.
double cantilever_frequency(int segments) {
  constexpr double length = 0.5, window = 0.005;
  Json json = parse_json(read_whole_file(std::filesystem::path(NOLI_SOURCE_DIR) / "scenes/cantilever.json"), "scene");
  Json& chain = json["bodies"][0]["mesh"]["chain"];
  chain["points"] = {{0, 0}, {segments * length / (segments - 0.5), 0}};
  chain["segments"] = segments;
  json["window"] = window;
  Simulation<double, 2> simulation(build_model<2>(parse_scene(json.dump(), "scene")).model);
  Books<double, 2> books;
  std::vector<double> tip;
  for (int k = 0; k < 2000; ++k) {
    simulation.run_window(books);
    tip.push_back(simulation.snapshot().x.back()[1]);
  }
  return frequency(tip, 0.5 * *std::min_element(tip.begin(), tip.end()), window);
}

TEST(Physics, ACantileverHasItsFrequency) {
  constexpr double young = 1e6, density = 100, thickness = 0.025, length = 0.5, root = 1.875104068711961;
  const double theory = root * root / (2 * std::numbers::pi) *
                        std::sqrt(young * thickness * thickness / (12 * density * length * length * length * length));
  const double coarse = std::abs(cantilever_frequency(10) - theory), fine = std::abs(cantilever_frequency(20) - theory);
  EXPECT_LT(coarse, 0.01 * theory);
  EXPECT_NEAR(coarse / fine, 4, 1);
}

/// The frequency of the first mode, sin(pi x / L), of a taut string of n segments between fixed ends. A lumped string
/// has the frequency (2 n / (2 pi L)) sin(pi / 2n) sqrt(tension / density), of second order in 1/n. The deflection is
/// small enough not to change the tension.
double string_frequency(int segments) {
  constexpr double length = 2, tension = 3, density = 0.5, natural = 0.5;  // natural: rest length over length
  Model<double, 2> model;
  const double d = length / segments, k = tension / (d * (1 - natural));
  const double step = 0.05 * std::sqrt(density * d / (4 * k));
  for (int i = 0; i <= segments; ++i) {
    model.x.emplace_back(i * d, 1e-5 * std::sin(std::numbers::pi * i / segments));
    model.v.emplace_back(0, 0);
    model.mass.push_back(density * d);
    if (i == segments) continue;
    const auto a = static_cast<VertexId>(i);
    model.forces.edge_springs.add({{a, a + 1}, k, natural * d, 0}, step);
  }
  model.pinned = {0, static_cast<VertexId>(segments)};
  model.window_length = 0.01;
  Simulation<double, 2> simulation(model);
  Books<double, 2> books;
  std::vector<double> middle;
  for (int i = 0; i < 3000; ++i) {
    simulation.run_window(books);
    middle.push_back(simulation.snapshot().x[static_cast<std::size_t>(segments) / 2][1]);
  }
  return frequency(middle, 0, model.window_length);
}

TEST(Physics, AStringHasItsFrequency) {
  const double theory = std::sqrt(3 / 0.5) / (2 * 2);
  const double coarse = std::abs(string_frequency(8) - theory), fine = std::abs(string_frequency(16) - theory);
  EXPECT_LT(coarse, 0.01 * theory);
  EXPECT_NEAR(coarse / fine, 4, 0.4);
}

/// Masses on springs of very different stiffness, so that steps differ by a factor of four or more.
Model<double, 2> uneven_chain() {
  Model<double, 2> model;
  const std::vector<double> stiffness = {1, 30, 1000, 5, 200};
  for (std::size_t i = 0; i <= stiffness.size(); ++i) {
    model.x.emplace_back(1.1 * static_cast<double>(i), 0.1 * test::noise(i));
    model.v.emplace_back(0, 0);
    model.mass.push_back(1);
  }
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    const auto a = static_cast<VertexId>(i);
    model.forces.edge_springs.add({{a, a + 1}, stiffness[i], 1, 0}, 0.1 / std::sqrt(stiffness[i]));
  }
  model.window_length = 0.5;
  return model;
}

TEST(Physics, EnergyHasNoTrendOverAThousandPeriods) {
  Simulation<double, 2> simulation(uneven_chain());
  ASSERT_GE((Engine<double, 2>(uneven_chain()).groups().size()), 3u);
  Books<double, 2> books;
  const auto energy = [&] {
    const auto s = simulation.state();
    return s.kinetic_mean + s.potential_sum();
  };
  // A thousand periods of the slowest motion, that of the softest spring between the masses on its sides.
  constexpr int windows = 13'000;
  std::vector<double> all;
  for (int i = 0; i < windows; ++i) {
    simulation.run_window(books);
    all.push_back(energy());
  }
  const auto mean = [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += all[i];
    return sum / static_cast<double>(end - begin);
  };
  const auto [low, high] = std::minmax_element(all.begin(), all.end());
  const double swing = *high - *low;
  EXPECT_GT(swing, 0);
  EXPECT_LT(swing, 0.05 * all.front());
  EXPECT_LT(std::abs(mean(0, windows / 4) - mean(3 * windows / 4, windows)), 0.05 * swing);
}

}  // namespace
}  // namespace noli::integrator
