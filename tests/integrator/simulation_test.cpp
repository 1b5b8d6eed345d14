// SPDX-License-Identifier: Apache-2.0
#include "integrator/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "integrator/clocks.h"
#include "integrator/kick.h"
#include "models.h"
#include "running.h"

namespace noli::integrator {
namespace {

using test::choose_steps;
using test::expect_same;
using test::run;
using test::sheet;
using test::SheetOptions;
using test::spring_pair;

TEST(Simulation, SpringPairIsVerletsSolution) {
  constexpr double m0 = 2, m1 = 0.5, k = 30, h = 0x1p-6, stretch = 0.25;
  Simulation<double, 3> simulation(spring_pair<3>(m0, m1, k, stretch, h));
  const double omega = std::sqrt(k * (1 / m0 + 1 / m1));
  const double phase = 2 * std::asin(0.5 * h * omega);  // phase of a step; Verlet's solution is exactly a cosine
  for (int window = 1; window <= 20; ++window) {
    run(simulation, 1);
    const auto s = simulation.snapshot();
    const double expected = stretch * std::cos(phase * 16 * window);
    EXPECT_NEAR(s.x[1][0] - s.x[0][0] - 1, expected, 1e-12);
    EXPECT_NEAR(m0 * s.x[0][0] + m1 * s.x[1][0], m1 * (1 + stretch), 1e-12);
  }
}

TEST(Simulation, FreeFallIsExact) {
  Model<double, 3> model = spring_pair<3>(1, 1, 0, 0, 1);
  model.v = {Vec<double, 3>(1, 0, 8), Vec<double, 3>(0, 2, 0)};
  model.forces = {};
  model.gravity = Gravity<double, 3>{{0, 0, -8}, 0x1p-5};
  model.window_length = 0.25;
  Simulation<double, 3> simulation(model);
  for (int i = 1; i <= 8; ++i) {
    run(simulation, 1);
    const double t = 0.25 * i;
    const auto s = simulation.snapshot();
    EXPECT_EQ(s.x[0], (Vec<double, 3>(t, 0, 8 * t - 4 * t * t)));
    EXPECT_EQ(s.x[1], (Vec<double, 3>(1, 2 * t, -4 * t * t)));
  }
}

TEST(Simulation, BooksMeetTheChangeOfKineticEnergy) {
  for (const double damping : {0.0, 1e-3}) {
    SheetOptions options;
    options.damping = damping;
    Model<double, 3> model = sheet(options);
    model.gravity = Gravity<double, 3>{{0, 0, -9.81}, 0x1p-10};
    model.pinned = {0, 6};
    choose_steps(model, 0.5);
    Simulation<double, 3> simulation(model);
    auto before = simulation.state();
    for (int window = 0; window < 20; ++window) {
      Books<double, 3> books;
      simulation.run_window(books);
      const auto after = simulation.state();
      const double in_play = std::abs(after.potential_sum()) + after.kinetic + before.kinetic;
      EXPECT_NEAR(after.kinetic - before.kinetic, books.work(), 1e-10 * in_play) << window;
      EXPECT_LE(books.of(ForceKind::membrane).damping_work, 0);
      EXPECT_EQ(books.of(ForceKind::membrane).damping_work == 0, damping == 0);
      EXPECT_NE(books.of(ForceKind::hinge).work, 0);
      EXPECT_NE(books.of(ForceKind::gravity).work, 0);
      before = after;
    }
  }
}

TEST(Simulation, BooksMeetTheChangeOfMomentum) {
  Model<double, 3> model = sheet({});
  model.gravity = Gravity<double, 3>{{0, 0, -9.81}, 0x1p-10};
  model.pinned = {0, 6};
  choose_steps(model, 0.5);
  Simulation<double, 3> simulation(model);
  const auto before = simulation.state();
  Books<double, 3> books;
  simulation.run_window(books);
  const auto after = simulation.state();
  Vec<double, 3> impulse = Vec<double, 3>::Zero(), angular = Vec<double, 3>::Zero();
  for (const auto& account : books.accounts) {
    impulse += account.impulse;
    angular += account.angular_impulse;
  }
  EXPECT_LE((after.momentum - before.momentum - impulse).norm(), 1e-12 * after.speeds);
  EXPECT_LE((after.angular_momentum - before.angular_momentum - angular).norm(), 1e-12 * after.moments);
  EXPECT_GT(books.of(ForceKind::membrane).impulse.norm(), 0);
}

TEST(Simulation, SlowMomentaOfAFreeSheetStayAfterTenMillionEvents) {
  Model<double, 3> model = sheet({});
  choose_steps(model, 0.5);
  Simulation<double, 3> simulation(model);
  const auto before = simulation.state();
  while (simulation.events() < 10'000'000) run(simulation, 1);
  const auto after = simulation.state();
  EXPECT_LE((after.momentum - before.momentum).norm(), 1e-12 * after.speeds);
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(), 1e-12 * after.moments);
}

/// The largest energy error at ends of windows.
double energy_error(double factor, std::uint64_t windows) {
  Model<double, 3> model = sheet({});
  model.v.assign(model.x.size(), Vec<double, 3>::Zero());
  choose_steps(model, factor);
  Simulation<double, 3> simulation(model);
  const auto start = simulation.state();
  const double energy = start.kinetic + start.potential_sum();
  double error = 0;
  for (std::uint64_t i = 0; i < windows; ++i) {
    run(simulation, 1);
    const auto s = simulation.state();
    error = std::max(error, std::abs(s.kinetic_mean + s.potential_sum() - energy));
  }
  return error / energy;
}

TEST(Simulation, EnergyIsOfSecondOrder) {
  const double coarse = energy_error(0.25, 40), fine = energy_error(0.125, 40);
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(coarse / fine, 4, 0.8);
}

TEST(Simulation, TimeCanBeReversed) {
  Model<double, 3> model = sheet({});
  choose_steps(model, 0.25);
  Simulation<double, 3> forth(model);
  run(forth, 10);
  const auto there = forth.snapshot();
  Model<double, 3> back_model = model;
  back_model.x = there.x;
  // The closing half kick of the forward run: v_mean is the velocity at this time, from which the backward run starts.
  back_model.v = forth.mean_velocities();
  for (auto& v : back_model.v) v = -v;
  Simulation<double, 3> back(back_model);
  run(back, 10);
  const auto home = back.snapshot();
  for (std::size_t i = 0; i < model.x.size(); ++i) {
    EXPECT_LE((home.x[i] - model.x[i]).norm(), 1e-10);
    EXPECT_LE((back.mean_velocities()[i] + model.v[i]).norm(), 1e-9);
  }
}

TEST(Simulation, GroupsAreTheSameEventsInARow) {
  Model<double, 3> model = sheet({});
  for (auto& h : model.forces.membranes.steps) h = model.window_length / 64;
  for (auto& h : model.forces.hinges.steps) h = model.window_length / 32;
  Model<double, 3> own = model;
  own.clocks = Clocks::own;
  Simulation<double, 3> a(model), b(own);
  run(a, 5);
  run(b, 5);
  expect_same(a.snapshot(), b.snapshot());
  EXPECT_EQ(a.events(), b.events());
  EXPECT_GT(a.events(), 5 * 64 * model.forces.membranes.forces.size());
}

TEST(Simulation, OwnClocksResumeBitForBit) {
  for (const Clocks clocks : {Clocks::grouped, Clocks::own}) {
    Model<double, 3> model = sheet({});
    model.clocks = clocks;
    choose_steps(model, 0.5);
    model.scripts = {{3, {0, 0.013, 0.05}, {model.x[3], model.x[3] + Vec<double, 3>(0, 0, 0.1), model.x[3]}}};
    Simulation<double, 3> whole(model);
    run(whole, 3);
    Simulation<double, 3> resumed(model, whole.snapshot());
    run(whole, 4);
    run(resumed, 4);
    expect_same(whole.snapshot(), resumed.snapshot());
  }
}

TEST(Simulation, RecordingChangesNothing) {
  Model<double, 3> model = sheet({});
  choose_steps(model, 0.5);
  Simulation<double, 3> a(model), b(model);
  Recording<double, 3> recording;
  Books<double, 3> books;
  for (int i = 0; i < 3; ++i) {
    recording.clear();
    a.run_window(recording, books);
  }
  run(b, 3);
  expect_same(a.snapshot(), b.snapshot());
}

TEST(Simulation, WorldLinesAreWhereTheVerticesWere) {
  Model<double, 3> model = sheet({});
  model.pinned = {0};
  model.scripts = {{3, {0, 0.005, 0.02}, {model.x[3], model.x[3] + Vec<double, 3>(0, 0, 0.1), model.x[3]}}};
  choose_steps(model, 0.5);
  Simulation<double, 3> simulation(model);
  Recording<double, 3> recording;
  Books<double, 3> books;
  simulation.run_window(recording, books);
  const WorldLines first = world_lines<3>(recording, model.x.size());
  const auto middle = simulation.snapshot();
  recording.clear();
  simulation.run_window(recording, books);
  const WorldLines second = world_lines<3>(recording, model.x.size());
  EXPECT_EQ(first.first_time(), 0);
  EXPECT_EQ(first.last_time(), 0.01);
  EXPECT_EQ(second.first_time(), 0.01);
  EXPECT_EQ(second.last_time(), 0.02);
  for (VertexId v = 0; v < model.x.size(); ++v) {
    const Position at_middle = {middle.x[v][0], middle.x[v][1], middle.x[v][2]};
    EXPECT_EQ(first.positions(v).back(), at_middle);
    EXPECT_EQ(second.positions(v).front(), at_middle);
    EXPECT_GE(first.times(v).size(), v == 0 ? 2 : 3);
  }
  EXPECT_EQ(first.times(0).size(), 2);  // pinned
  const Position top = {model.x[3][0], model.x[3][1], model.x[3][2] + 0.1};
  EXPECT_EQ(first.times(3).size(), 3);
  EXPECT_EQ(first.times(3)[1], 0.005);
  EXPECT_EQ(first.positions(3)[1], top);
  EXPECT_EQ(second.positions(3).back(), (Position{model.x[3][0], model.x[3][1], model.x[3][2]}));
}

TEST(Simulation, AForceThatDoesNothingLeavesNoTrace) {
  Model<double, 2> model = spring_pair<2>(1, 1, 10, 0, 0x1p-8);  // at rest length
  Simulation<double, 2> simulation(model);
  Recording<double, 2> recording;
  Books<double, 2> books;
  simulation.run_window(recording, books);
  EXPECT_EQ(recording.stream().size(), 4);  // two vertices, two ends
  model.x[1][0] = 1.5;
  Simulation<double, 2> stretched(model);
  recording.clear();
  stretched.run_window(recording, books);
  EXPECT_EQ(recording.stream().size(), 2 + 2 * 16);
}

TEST(Simulation, PlaneMotionHasTwoCoordinates) {
  Model<double, 2> model = spring_pair<2>(1, 1, 10, 0.1, 0x1p-8);
  Simulation<double, 2> simulation(model);
  EXPECT_EQ(simulation.snapshot().x[0].size(), 2);
  EXPECT_LT(sizeof(Breakpoint<double, 2>), sizeof(Breakpoint<double, 3>));
  EXPECT_LT(sizeof(Particle<double, 2>), sizeof(Particle<double, 3>));
}

TEST(Simulation, WhatIsNotFiniteIsFound) {
  Model<double, 3> model = spring_pair<3>(1e-30, 1, 1e300, 0.5, 0x1p-4);
  Simulation<double, 3> simulation(model), again(model);
  EXPECT_TRUE(simulation.finite());
  run(simulation, 1);
  EXPECT_FALSE(simulation.finite());
  const auto go_on = [] { return false; };
  const std::optional<NotFinite> found = again.find_not_finite(go_on);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, ForceKind::edge_spring);
  EXPECT_EQ(found->force, (std::vector<VertexId>{0, 1}));
  EXPECT_EQ(found->vertex, 0);
  EXPECT_GE(found->time, 0);
  Simulation<double, 3> calm(spring_pair<3>(1, 1, 10, 0.1, 0x1p-4));
  EXPECT_THROW(calm.find_not_finite(go_on), std::logic_error);
}

TEST(Simulation, StopsWithinAWindow) {
  for (const Clocks clocks : {Clocks::grouped, Clocks::own}) {
    Model<double, 3> model = spring_pair<3>(1, 1, 10, 0.1, 0x1p-20);
    model.clocks = clocks;
    model.window_length = 0x1p-3;
    Simulation<double, 3> stopped(model), asked(model), whole(model);
    Recording<double, 3> recording, another;
    Books<double, 3> books, other_books;
    int questions = 0;
    EXPECT_FALSE(stopped.run_window(recording, books, [&] { return ++questions == 3; }));
    EXPECT_EQ(questions, 3);
    EXPECT_EQ(stopped.windows(), 0);
    EXPECT_LT(stopped.events(), 60000);
    Simulation<double, 3> searched(model);
    EXPECT_FALSE(searched.find_not_finite([] { return true; }).has_value());
    recording.clear();
    books = {};
    EXPECT_TRUE(asked.run_window(recording, books, [&] { return ++questions < 0; }));
    whole.run_window(another, other_books);
    EXPECT_GT(questions, 3 + static_cast<int>(whole.events() >> 15));
    expect_same(asked.snapshot(), whole.snapshot());
    EXPECT_EQ(recording.stream().size(), another.stream().size());
  }
}

TEST(Simulation, ModelsThatAreNoneAreRefused) {
  const auto good = spring_pair<3>(1, 1, 10, 0.1, 0x1p-4);
  EXPECT_NO_THROW((Simulation<double, 3>{good}));
  auto bad = good;
  bad.mass[0] = 0;
  EXPECT_THROW((Simulation<double, 3>{bad}), std::invalid_argument);
  bad = good;
  bad.forces.edge_springs.steps[0] = 0;
  EXPECT_THROW((Simulation<double, 3>{bad}), std::invalid_argument);
  bad = good;
  bad.forces.edge_springs.forces[0].vertices[1] = 2;
  EXPECT_THROW((Simulation<double, 3>{bad}), std::invalid_argument);
  bad = good;
  bad.window_length = 0;
  EXPECT_THROW((Simulation<double, 3>{bad}), std::invalid_argument);
}

/// A plain implementation of Algorithm 1 with own clocks: fires one force after the other, from a sorted list.
class OneByOne {
 public:
  explicit OneByOne(const Model<double, 3>& model) : model_(model), t_(model.x.size(), 0.0) {
    for (std::size_t i = 0; i < count(); ++i) kick(i, 0, 0.5 * step(i));
  }

  void run_to(double end) {
    std::vector<std::pair<double, std::size_t>> events;
    for (std::size_t i = 0; i < count(); ++i) {
      for (Clock clock{step(i), first_after(begin_, step(i))}; clock.time() <= end; ++clock.next) {
        events.emplace_back(clock.time(), i);
      }
    }
    std::sort(events.begin(), events.end());
    for (const auto& [t, i] : events) kick(i, t, step(i));
    for (VertexId v = 0; v < t_.size(); ++v) {
      model_.x[v] = at(v, end);
      t_[v] = end;
    }
    begin_ = end;
  }

  const Model<double, 3>& model() const { return model_; }

 private:
  std::size_t springs() const { return model_.forces.edge_springs.forces.size(); }
  std::size_t count() const { return springs() + model_.forces.hinges.forces.size(); }
  double step(std::size_t i) const {
    return i < springs() ? model_.forces.edge_springs.steps[i] : model_.forces.hinges.steps[i - springs()];
  }
  Vec<double, 3> at(VertexId v, double t) const { return model_.x[v] + (t - t_[v]) * model_.v[v]; }

  void kick(std::size_t i, double t, double h) {
    if (i < springs()) {
      kick(model_.forces.edge_springs.forces[i], t, h);
    } else {
      kick(model_.forces.hinges.forces[i - springs()], t, h);
    }
  }

  template <class F>
  void kick(const F& force, double t, double h) {
    VertexVectors<double, 3, F::size> x;
    for (std::size_t i = 0; i < F::size; ++i) x[i] = at(force.vertices[i], t);
    const auto gradient = force.gradient(x);
    for (std::size_t i = 0; i < F::size; ++i) {
      const VertexId v = force.vertices[i];
      const Vec<double, 3> after = model_.v[v] + 1 / model_.mass[v] * (-h * gradient[i]);
      if (after == model_.v[v]) continue;
      model_.x[v] = x[i];
      t_[v] = t;
      model_.v[v] = after;
    }
  }

  Model<double, 3> model_;
  std::vector<double> t_;
  double begin_ = 0;
};

/// Forces without a common vertex are fired together, which must not change the result.
TEST(Simulation, WithClocksOfTheirOwnForcesFireAsIfOneByOne) {
  for (const int cells : {1, 3, 12}) {
    SheetOptions options;
    options.cells = cells;
    options.membrane = false;
    options.window = 0.25;
    Model<double, 3> model = sheet(options);
    model.clocks = Clocks::own;
    choose_steps(model, 0.5);
    for (std::size_t i = 0; i < model.forces.edge_springs.steps.size(); ++i) {
      model.forces.edge_springs.steps[i] *= 1 + 0.1 * test::noise(i);
    }
    Simulation<double, 3> simulation(model);
    OneByOne reference(model);
    for (int window = 1; window <= 5; ++window) {
      run(simulation, 1);
      reference.run_to(window * model.window_length);
      const auto s = simulation.snapshot();
      for (std::size_t i = 0; i < s.x.size(); ++i) {
        ASSERT_EQ(s.x[i], reference.model().x[i]) << i;
        ASSERT_EQ(s.v[i], reference.model().v[i]) << i;
      }
    }
    EXPECT_GT(simulation.events(), 200u);
  }
}

}  // namespace
}  // namespace noli::integrator
