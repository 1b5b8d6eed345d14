// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "contact_models.h"
#include "proofs/prover/windows/window_verifier.h"
#include "running.h"
#include "tests/support/literal_simulation.h"

namespace noli::integrator {
namespace {

using noli::test::LiteralSimulation;
using test::ball_and_floor;
using test::colliding_sheets;
using test::ContactOptions;
using test::expect_same;
using test::run;
using test::run_of;
using test::with_contact;

struct Variant {
  const char* name;
  double speed;
  ContactOptions contact;
  Clocks clocks;
};

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

class Colliding : public testing::TestWithParam<Variant> {
 protected:
  Model<double, 3> model(int cells) const {
    Model<double, 3> result = with_contact(colliding_sheets(cells, GetParam().speed), GetParam().contact);
    result.clocks = GetParam().clocks;
    return result;
  }
};

INSTANTIATE_TEST_SUITE_P(Contact, Colliding,
                         testing::Values(Variant{"Gentle", 1, {}, Clocks::grouped},
                                         Variant{"Fast", 8, {}, Clocks::grouped},
                                         Variant{"OwnClocks", 2, {}, Clocks::own},
                                         Variant{"Restitution", 3, {0.01, 100, 0.05, 0.25, 0}, Clocks::grouped},
                                         Variant{"Friction", 3, {0.01, 100, 0.05, 1, 0.4}, Clocks::grouped},
                                         Variant{"All", 4, {0.01, 200, 0.1, 0.5, 0.3}, Clocks::grouped}));

TEST_P(Colliding, CellsEqualTheLiteralAlgorithm) {
  Model<double, 3> literal = model(4);
  Simulation<double, 3> cells(literal);
  LiteralSimulation<3> every_pair(literal);
  for (int w = 0; w < 12; ++w) {
    run(cells, 1);
    run_of<3>(every_pair, 1);
    ASSERT_NO_FATAL_FAILURE(expect_same(cells.snapshot(), every_pair.snapshot())) << w;
  }
  EXPECT_GE(cells.certificates().deepest, 2U);
}

TEST_P(Colliding, LayersActivatedInTimeEqualLayersThatAlwaysAre) {
  Model<double, 3> eager = model(2);
  Simulation<double, 3> lazy(eager);
  run(lazy, 4);
  EXPECT_GE(lazy.certificates().deepest, 1U);
  eager.contact->least_layers = lazy.certificates().deepest;
  LiteralSimulation<3> always(eager);
  run_of<3>(always, 4);
  EXPECT_EQ(always.certificates().deepest, lazy.certificates().deepest);
  expect_same(lazy.snapshot(), always.snapshot());
}

/// The deepest layer that acts within `windows` windows.
std::uint32_t deepest_that_acts(Simulation<double, 3>& simulation, int windows) {
  std::uint32_t deepest = 0;
  for (int w = 0; w < windows; ++w) {
    run(simulation, 1);
    const ContactExtremes extremes = simulation.extremes();
    if (extremes.deepest) deepest = std::max(deepest, extremes.deepest->layer);
  }
  return deepest;
}

std::optional<ContactLimit> limit_of(const Model<double, 3>& model, int windows) {
  Simulation<double, 3> simulation(model);
  try {
    run(simulation, windows);
  } catch (const ContactLimit& limit) {
    return limit;
  }
  return std::nullopt;
}

/// The number of layers activated in advance depends on when certificates look, which differs in a resumed run.
TEST_P(Colliding, WhatEndsARunIsALayerThatActsNotOneThatIsTakenInAdvance) {
  constexpr int windows = 8;
  Model<double, 3> model = this->model(3);
  Simulation<double, 3> unlimited(model);
  const std::uint32_t acting = deepest_that_acts(unlimited, windows);
  ASSERT_GE(acting, 2U);

  model.contact->most_layers = acting;
  model.contact->least_layers = 2 * acting;
  Simulation<double, 3> eager(model);
  run(eager, windows);
  EXPECT_GT(eager.certificates().deepest, acting);
  expect_same(unlimited.snapshot(), eager.snapshot());

  model.contact->most_layers = acting - 1;
  model.contact->least_layers = 2 * (acting - 1);
  const std::optional<ContactLimit> early = limit_of(model, windows);
  model.contact->least_layers = 0;
  const std::optional<ContactLimit> late = limit_of(model, windows);
  ASSERT_TRUE(early && late);
  EXPECT_EQ(early->time, late->time);
  EXPECT_EQ(early->pair.key, late->pair.key);
}

TEST_P(Colliding, GoesOnFromASnapshotAsIfNothingHadHappened) {
  Simulation<double, 3> whole(model(5));
  run(whole, 5);
  Simulation<double, 3> resumed(model(5), whole.snapshot());
  run(whole, 5);
  run(resumed, 5);
  expect_same(whole.snapshot(), resumed.snapshot());
}

TEST_P(Colliding, TouchesNothing) {
  const Model<double, 3> m = model(6);
  WindowOptions options;
  options.threads = 1;
  const WindowVerifier verifier(m.mesh, test::positions(m), options);
  Simulation<double, 3> simulation(m);
  Recording<double, 3> recording;
  std::uint64_t acted = 0;
  for (int w = 0; w < 12; ++w) {
    recording.clear();
    Books<double, 3> books;
    simulation.run_window(recording, books);
    acted += books.of(ForceKind::contact).events;
    const WindowResult result = verifier.verify(world_lines<3>(recording, m.x.size()), options);
    ASSERT_TRUE(result.complete);
    ASSERT_EQ(result.contact_count() + result.initial_intersections, 0U) << w;
  }
  EXPECT_GT(acted, 100U);
}

TEST_P(Colliding, KeepsMomentumAndItsBooks) {
  Simulation<double, 3> simulation(model(6));
  const auto before = simulation.state();
  auto last = before;
  for (int w = 0; w < 12; ++w) {
    const Books<double, 3> books = run(simulation, 1);
    const auto state = simulation.state();
    const double scale = state.kinetic + std::abs(state.potential_sum());
    EXPECT_NEAR(state.kinetic - last.kinetic, books.work(), 1e-10 * scale) << w;
    EXPECT_LE(books.of(ForceKind::contact).damping_work, 0);
    EXPECT_LT((state.momentum - before.momentum).norm(), 1e-12 * state.speeds) << w;
    EXPECT_LT((state.angular_momentum - before.angular_momentum).norm(), 1e-12 * state.moments) << w;
    last = state;
  }
}

TEST(Contact, EnergyStaysWithoutRestitutionAndFriction) {
  Simulation<double, 3> simulation(with_contact(colliding_sheets(6, 3), {0.01, 100, 0.02, 1, 0}));
  const auto before = simulation.state();
  const double energy = before.kinetic_mean + before.potential_sum();
  run(simulation, 20);
  const auto after = simulation.state();
  EXPECT_NEAR(after.kinetic_mean + after.potential_sum(), energy, 0.01 * energy);
  EXPECT_GE(simulation.certificates().deepest, 2U);
}

/// Relative change of the kinetic energy by one impact at 3 m/s from this initial height.
double impact(double c, double height, double restitution = 1) {
  ContactOptions o{0.1, 1000, c, restitution, 0};
  Model<double, 2> model = with_contact(ball_and_floor(height, 3), o);
  model.contact->materials[0].step = c / std::sqrt(1000.0);  // the floor is immovable: 1 / m_eff = 1 / m
  Simulation<double, 2> simulation(model);
  run(simulation, 30);
  const auto s = simulation.snapshot();
  EXPECT_GT(s.v[0][1], 0);
  EXPECT_GT(s.x[0][1], 0.1);
  return s.v[0].squaredNorm() / 9 - 1;
}

struct ImpactError {
  double c, deviation;
};

class Impacts : public testing::TestWithParam<ImpactError> {};

INSTANTIATE_TEST_SUITE_P(Contact, Impacts,
                         testing::Values(ImpactError{0.2, 8.1e-3}, ImpactError{0.1, 1.8e-3}, ImpactError{0.05, 4.2e-4},
                                         ImpactError{0.02, 7.8e-5}));

/// docs/contact.md, 3.
TEST_P(Impacts, ChangeEnergyByNothingOnAverage) {
  constexpr int count = 1000;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const double error = impact(GetParam().c, 0.2 + 0.01 * (1 + test::noise(static_cast<std::uint64_t>(i))));
    sum += error;
    squares += error * error;
  }
  const double mean = sum / count, deviation = std::sqrt(squares / count - mean * mean);
  EXPECT_NEAR(deviation, GetParam().deviation, 0.15 * GetParam().deviation);
  EXPECT_LT(std::abs(mean), 3 * deviation / std::sqrt(double{count}));
}

/// docs/contact.md, 4: a share e of the energy comes back.
TEST(Contact, RestitutionIsTheShareOfTheEnergyThatComesBack) {
  for (const double e : {0.5, 0.25, 0.1}) {
    double sum = 0;
    constexpr int count = 1000;
    for (int i = 0; i < count; ++i) {
      sum += std::sqrt(1 + impact(0.05, 0.2 + 0.01 * (1 + test::noise(static_cast<std::uint64_t>(i))), e));
    }
    EXPECT_NEAR(sum / count, std::sqrt(e), 0.005 * std::sqrt(e)) << e;
  }
}

TEST(Contact, NoSpeedGetsThrough) {
  for (const double speed : {1.0, 30.0, 300.0, 1000.0}) {
    Model<double, 2> model = with_contact(ball_and_floor(0.2, speed), {0.1, 1000, 0.05, 1, 0});
    Simulation<double, 2> simulation(model);
    run(simulation, 40);
    EXPECT_GT(simulation.snapshot().x[0][1], 0) << speed;
    EXPECT_GT(simulation.snapshot().v[0][1], 0) << speed;
  }
}

TEST(Contact, WhatIsExcludedPassesThrough) {
  Model<double, 2> model = with_contact(ball_and_floor(0.2, 3), {});
  model.contact->groups = {0, 1, 1};
  model.contact->group_count = 2;
  model.contact->material_of = {0, ContactSettings::excluded, ContactSettings::excluded, 0};
  Simulation<double, 2> simulation(model);
  run(simulation, 20);
  EXPECT_NEAR(simulation.snapshot().x[0][1], 0.2 - 0.6, 1e-12);
}

TEST(Contact, APairThatNeedsMoreLayersThanAllowedEndsTheRun) {
  Model<double, 2> model = with_contact(ball_and_floor(0.2, 300), {0.1, 1000, 0.05, 1, 0});
  model.contact->most_layers = 3;
  Simulation<double, 2> simulation(model);
  try {
    run(simulation, 40);
    FAIL() << "expected a ContactLimit";
  } catch (const ContactLimit& limit) {
    EXPECT_EQ(limit.pair.kind, FeaturePair::vertex_edge);
    EXPECT_GT(limit.time, 0);
    EXPECT_LT(limit.time, 0.2 / 300);
  }
}

}  // namespace
}  // namespace noli::integrator
