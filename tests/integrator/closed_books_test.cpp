// SPDX-License-Identifier: Apache-2.0
//
// Tests that the energy accounts are complete: every joule that free particles gain or lose is booked. The rest of the
// change of K + V is the error of finite steps (integrator/books.h, State::energy).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "contact_models.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "running.h"

namespace noli::integrator {
namespace {

using test::ball_and_floor;
using test::with_contact;

/// The limits of a run; it ends at the first one that it reaches.
struct Limit {
  int windows;
  std::uint64_t events = 1'000'000'000;          ///< of forces
  std::uint64_t contact_events = 1'000'000'000;  ///< of layers of contact
};

/// The largest |dK - booked work| of a window, over the energies in play; adds what was booked to `all`.
template <int Dim>
double worst_gap(const Model<double, Dim>& model, Limit limit, Books<double, Dim>& all) {
  Simulation<double, Dim> simulation(model);
  auto before = simulation.state();
  double worst = 0, most = 0;
  const auto go_on = [&] {
    return simulation.events() < limit.events && all.of(ForceKind::contact).events < limit.contact_events;
  };
  for (int w = 0; w < limit.windows && go_on(); ++w) {
    const Books<double, Dim> books = test::run(simulation, 1);
    const auto after = simulation.state();
    double in_play = after.kinetic + before.kinetic;
    for (const double v : after.potential) in_play += std::abs(v);
    for (const auto& a : books.accounts) in_play += std::abs(a.work) + std::abs(a.held_work);
    most = std::max(most, in_play);
    worst = std::max(worst, std::abs(after.kinetic - before.kinetic - books.work()));
    all += books;
    before = after;
  }
  return worst / most;
}

// --- Every joule has an entry ----------------------------------------------------------------------------------------

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(NOLI_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

class ClosedBooks : public testing::TestWithParam<std::string> {
 public:
  const Scene scene = read_scene(std::filesystem::path(NOLI_SOURCE_DIR) / "scenes" / (GetParam() + ".json"));

  /// Runs up to `events` events of forces, or 100,000 of contact; returns the number of contact events.
  std::uint64_t expect_closed(std::uint64_t events) const {
    return scene.dimension == 2 ? expect_closed<2>(events) : expect_closed<3>(events);
  }

 private:
  template <int Dim>
  std::uint64_t expect_closed(std::uint64_t events) const {
    const auto windows = static_cast<int>(windows_up_to(scene.duration, scene.window));
    Books<double, Dim> all;
    const Model<double, Dim> model = build_model<Dim>(scene).model;
    const double gap = worst_gap<Dim>(model, Limit{windows, events, 100'000}, all);
    std::printf("%s: %.2g\n", GetParam().c_str(), gap);
    EXPECT_LE(gap, 1e-10);
    double by_script = 0, held = 0;
    for (const double w : all.scripts) by_script += w;
    for (const auto& a : all.accounts) held += a.held_work;
    EXPECT_NEAR(by_script, held, 1e-10 * (1 + std::abs(held))) << "what is pinned does no work";
    for (std::size_t m = 0; m < all.contact.size(); ++m) {
      const ContactMaterial& material = model.contact->materials[m];
      if (material.friction == 0) {
        EXPECT_EQ(all.contact[m].damping_work, 0) << "material " << m;
      }
      if (material.restitution == 1) {
        EXPECT_EQ(all.contact[m].restitution_work, 0) << "material " << m;
      }
    }
    return all.of(ForceKind::contact).events;
  }
};

TEST_P(ClosedBooks, WorksAddUpToTheChangeOfKineticEnergy) { expect_closed(100'000); }

TEST_P(ClosedBooks, SlowWorksAddUpWhereThingsTouch) {
  EXPECT_EQ(expect_closed(1'000'000'000) > 0, scene.contact.has_value());
}

INSTANTIATE_TEST_SUITE_P(Scenes, ClosedBooks, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

// --- Restitution -----------------------------------------------------------------------------------------------------

struct Bounce {
  double restitution;
  Account<double, 2> contact;
  double begin, end;  ///< K + V
};

Bounce bounce(double restitution) {
  Model<double, 2> model = with_contact(ball_and_floor(0.2, 3), {0.1, 1000, 0.02, restitution, /*friction=*/0});
  model.contact->materials[0].step = 0.02 / std::sqrt(1000.0);
  Books<double, 2> all;
  EXPECT_LE(worst_gap<2>(model, {60}, all), 1e-12);
  Simulation<double, 2> simulation(model);
  const double begin = simulation.state().energy();
  test::run(simulation, 60);
  EXPECT_EQ(all.contact.at(0).restitution_work, all.of(ForceKind::contact).restitution_work);
  return {restitution, all.of(ForceKind::contact), begin, simulation.state().energy()};
}

/// A ball that arrives with v and leaves with sqrt(e) v loses (1 - e) m v^2 / 2 to restitution and nothing to anything
/// else, up to the error of finite steps.
TEST(RestitutionBooks, HaveWhatTheBallHasLost) {
  for (const double restitution : {1.0, 0.5, 0.01}) {
    const Bounce found = bounce(restitution);
    EXPECT_NEAR(found.contact.restitution_work, (restitution - 1) * found.begin, 0.01 * found.begin);
    EXPECT_NEAR(found.end - found.begin, found.contact.restitution_work, 0.01 * found.begin);
    EXPECT_LE(std::abs(found.contact.work), 0.01 * found.begin) << "what a potential takes it gives back";
    EXPECT_EQ(found.contact.damping_work, 0);
    EXPECT_EQ(found.contact.held_work, 0) << "the floor does not move";
  }
  EXPECT_EQ(bounce(1).contact.restitution_work, 0);
}

/// With e = 0, a receding ball gets no impulse, but the potential still falls; that must be booked.
TEST(RestitutionBooks, HaveWhatNoImpulseGives) {
  const Bounce found = bounce(0);
  EXPECT_LT(found.contact.restitution_work, -0.01 * found.begin);
  EXPECT_NEAR(found.end - found.begin, found.contact.restitution_work, 0.01 * found.begin);
}

/// A run that begins within a layer begins with its potential, which only contact_at_start() reports.
TEST(ContactAtStart, IsThePotentialOfLayersThatActThere) {
  Model<double, 2> model = with_contact(ball_and_floor(0.09, 0), {0.1, 1000, 0.02, 1, 0});
  Simulation<double, 2> simulation(model);
  EXPECT_EQ(simulation.contact_at_start(), 0);
  const double begin = simulation.state().energy();
  test::run(simulation, 1);
  EXPECT_NEAR(simulation.contact_at_start(), 0.5 * 1000 * 0.01 * 0.01, 1e-12) << "the second layer begins at 0.084 m";
  EXPECT_NEAR(simulation.state().energy(), begin + simulation.contact_at_start(), 0.02 * simulation.contact_at_start());
  Simulation<double, 2> above(with_contact(ball_and_floor(0.2, 0), {0.1, 1000, 0.02, 1, 0}));
  test::run(above, 1);
  EXPECT_EQ(above.contact_at_start(), 0);
}

// --- Scripts ---------------------------------------------------------------------------------------------------------

struct Towed {
  double damping;
  double step;
};

/// One end of a spring follows a smooth path, the other is free. The path's corners coincide with events.
Model<double, 2> towed(const Towed& how) {
  Model<double, 2> model;
  model.x = {{0, 0}, {1, 0}};
  model.v.assign(2, Vec<double, 2>::Zero());
  model.mass = {1, 2};
  model.window_length = 0x1p-4;
  model.forces.edge_springs.add({{0, 1}, 50, 1, how.damping}, how.step);
  Script<double, 2> script{0, {}, {}};
  constexpr int corners = 1 << 12;
  for (int k = 0; k <= 2 * corners; ++k) {
    const double t = static_cast<double>(k) / corners;
    script.times.push_back(t);
    script.positions.emplace_back(0.3 * (1 - std::cos(std::numbers::pi * t)), 0);
  }
  model.scripts = {script};
  return model;
}

/// The largest `integration` entry: the change of K + V minus everything booked.
double integration(const Towed& how) {
  Simulation<double, 2> simulation(towed(how));
  const double begin = simulation.state().energy();
  double sum = 0, worst = 0;
  for (int w = 0; w < 32; ++w) {
    const Books<double, 2> books = test::run(simulation, 1);
    EXPECT_EQ(books.scripts.size(), 1U);
    EXPECT_NEAR(books.scripts[0], books.of(ForceKind::edge_spring).held_work, 1e-14);
    sum += books.given();
    worst = std::max(worst, std::abs(simulation.state().energy() - begin - sum));
  }
  EXPECT_GT(std::abs(sum), 0.01) << "the script gave something";
  return worst;
}

TEST(ScriptBooks, WhatIsLeftFallsFourfoldWhenStepsAreHalved) {
  for (const double damping : {0.0, 0.01}) {
    const double coarse = integration({damping, 0x1p-8}), fine = integration({damping, 0x1p-9});
    std::printf("damping %g s: integration %.3g J, %.3g J with half the step: %.3f\n", damping, coarse, fine,
                coarse / fine);
    EXPECT_NEAR(coarse / fine, 4, 0.2);
  }
}

/// Of two scripts, the pulling one does work, and the one that holds a vertex at rest does none.
TEST(ScriptBooks, AreByScript) {
  Model<double, 2> model = test::chain<2>({{0, 0}, {1, 0}, {2, 0}}, false, 100, 1);
  model.forces.turnings = {};
  for (double& h : model.forces.edge_springs.steps) h = 0x1p-9;
  model.scripts.push_back({0, {0, 1}, {{0, 0}, {-1, 0}}, 0});
  model.scripts.push_back({2, {0, 1}, {{2, 0}, {2, 0}}, 1});
  Books<double, 2> all;
  EXPECT_LE(worst_gap<2>(model, {50}, all), 1e-12);
  ASSERT_EQ(all.scripts.size(), 2U);
  EXPECT_GT(all.scripts[0], 0.1);
  EXPECT_EQ(all.scripts[1], 0);
}

// --- Damping ---------------------------------------------------------------------------------------------------------

/// A damped oscillator whose (hw)^2 is not small. Without damping, leapfrog conserves m v^2 / 2 + k s s' / 2, where s
/// and s' are the strains at both ends of a step (Hairer, Lubich, Wanner 2003, section 1.4, for the linear oscillator).
/// An impulse changes it by its work, computed with the velocity in the middle of the event. Velocities after the kick
/// would give (hw)^2 / 4 = 6 % more.
TEST(DampingBooks, AreOfTheMiddleOfTheEvent) {
  Model<double, 2> model;
  model.x = {{0, 0}, {1.2, 0}};
  model.v.assign(2, Vec<double, 2>::Zero());
  model.mass = {1, 1};
  model.pinned = {0};
  constexpr double h = 0x1p-6, hw = 0.5, stiffness = hw * hw / (h * h);
  model.window_length = 1;
  model.forces.edge_springs.add({{0, 1}, stiffness, 1, 1e-5}, h);
  Simulation<double, 2> simulation(model);
  const auto kept = [&] {
    const auto s = simulation.snapshot();
    const double strain = s.x[1][0] - 1, v = s.v[1][0];
    return 0.5 * v * v + 0.5 * stiffness * strain * (strain + h * v);
  };
  test::run(simulation, 1);
  const double before = kept();
  const Books<double, 2> books = test::run(simulation, 20);
  const double lost = before - kept(), booked = -books.of(ForceKind::edge_spring).damping_work;
  EXPECT_GT(lost, 0.05 * before);
  EXPECT_NEAR(booked / lost, 1, 1e-10);
}

struct ChainBooks {
  double damping, integration;
};

ChainBooks of_hanging_chain(double step_factor) {
  Scene scene = read_scene(std::filesystem::path(NOLI_SOURCE_DIR) / "scenes/hanging_chain.json");
  scene.step_factor = step_factor;
  Simulation<double, 2> simulation(build_model<2>(scene).model);
  const State<double, 2> begin = simulation.state();
  const Books<double, 2> books = test::run(simulation, 100);
  const double damping = books.given(), energy = simulation.state().energy();
  return {damping, energy - begin.energy() - damping};
}

/// Links that nearly balance would each throw a vertex back and forth at every step. With the velocities in between,
/// the work of damping would be three and a half times too large.
TEST(DampingBooks, AreOfAllThatStrikeAtOneTime) {
  const ChainBooks coarse = of_hanging_chain(0.5), fine = of_hanging_chain(0.0625);
  std::printf("damping %.4g J, with an eighth of the steps %.4g J; integration %.2g J, %.2g J\n", coarse.damping,
              fine.damping, coarse.integration, fine.integration);
  EXPECT_LT(coarse.damping, -0.03);
  EXPECT_NEAR(coarse.damping / fine.damping, 1, 0.03);
  EXPECT_LE(std::abs(coarse.integration), 0.03 * std::abs(fine.damping));
  EXPECT_LE(std::abs(fine.integration), 0.005 * std::abs(fine.damping));
}

/// A mass hangs at rest: gravity pulls it down and the spring pulls it back at the same time.
TEST(BooksOfOneTime, HaveNoWorkOfWhatBalances) {
  Model<double, 2> model;
  model.x = {{0, 0}, {0, -2}};
  model.v.assign(2, Vec<double, 2>::Zero());
  model.mass = {1, 1};
  model.pinned = {0};
  model.window_length = 1;
  model.forces.edge_springs.add({{0, 1}, 8, 1, 0}, 0x1p-6);
  model.gravity = {{0, -8}, 0x1p-6};
  Simulation<double, 2> simulation(model);
  const Books<double, 2> books = test::run(simulation, 3);
  EXPECT_EQ(books.of(ForceKind::gravity).work, 0);
  EXPECT_EQ(books.of(ForceKind::edge_spring).work, 0);
  EXPECT_EQ(books.of(ForceKind::gravity).impulse[1], -8 * (3 + 0x1p-7)) << "with the half kick at the start";
  model.gravity->acceleration = {0, -16};  // now it falls
  Simulation<double, 2> falling(model);
  EXPECT_GT(test::run(falling, 1).of(ForceKind::gravity).work, 1);
}

}  // namespace
}  // namespace noli::integrator
