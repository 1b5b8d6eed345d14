// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "audit/numerics/implicit_euler.h"
#include "audit/numerics/integrator_audit.h"
#include "audit/numerics/one_step.h"
#include "audit/numerics/sampled_run.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"

namespace noli::audit {
namespace {

using integrator::Model;

/// Two masses of 1 kg, 1 m apart, on a spring of 1 N/m: their distance oscillates with angular frequency sqrt(2).
Model<double, 2> two_masses(double step) {
  Model<double, 2> model;
  model.mesh.vertex_count = 2;
  model.mesh.edges = {{0, 1}};
  model.x = {{0, 0}, {1, 0}};
  model.v = {{-0.1, 0}, {0.1, 0}};
  model.mass = {1, 1};
  model.forces.edge_springs.add({{0, 1}, 1, 1, 0}, step);
  model.window_length = 0.5;
  return model;
}

/// The exact motion of the second mass.
double exact(double t) { return 1 + 0.1 / std::sqrt(2.0) * std::sin(std::sqrt(2.0) * t); }

TEST(SampledRun, MethodsOfSecondOrderComeNearAndImplicitEulerLessSo) {
  const auto error = [](const SampledRun<2>& run) {
    double worst = 0;
    for (std::size_t i = 0; i < run.samples.size(); ++i) {
      worst = std::max(worst, std::abs(run.samples[i].x[1][0] - exact(0.5 * static_cast<double>(i))));
    }
    return worst;
  };
  const auto clocks = [](double h) { return run_with_clocks(two_masses(h), 8); };
  const auto plain = [](double h) { return run_plain(two_masses(h), h, 8); };
  const auto euler = [](double h) { return run_implicit_euler(two_masses(h), h, 8); };
  const double h = 0.0625;
  EXPECT_NEAR(error(clocks(h)) / error(clocks(h / 2)), 4, 0.1);
  EXPECT_NEAR(error(plain(h)) / error(plain(h / 2)), 4, 0.1);
  EXPECT_NEAR(error(euler(h)) / error(euler(h / 2)), 2, 0.2);
  EXPECT_NEAR(error(plain(h)), error(clocks(h)), 1e-12);
  EXPECT_GT(error(euler(h)), 10 * error(clocks(h)));
  EXPECT_TRUE(euler(h).converged);
}

TEST(SampledRun, VelocitiesAreThoseOfTheTime) {
  for (const SampledRun<2>& run :
       {run_with_clocks(two_masses(0.03125), 8), run_plain(two_masses(0.03125), 0.03125, 8)}) {
    ASSERT_EQ(run.samples.size(), 9u);
    for (std::size_t i = 0; i < run.samples.size(); ++i) {
      EXPECT_NEAR(run.samples[i].v[1][0], 0.1 * std::cos(std::sqrt(2.0) * 0.5 * static_cast<double>(i)), 1e-4) << i;
    }
  }
}

TEST(SampledRun, PinnedMassesStayAndGravityPulls) {
  Model<double, 2> model = two_masses(0.0625);
  model.pinned = {0};
  model.gravity = {{0, -1}, 0.0625};
  for (const SampledRun<2>& run :
       {run_with_clocks(model, 2), run_plain(model, 0.0625, 2), run_implicit_euler(model, 0.001953125, 2)}) {
    const Sample<2>& last = run.samples.back();
    EXPECT_EQ(last.x[0], model.x[0]);
    EXPECT_NEAR(last.x[1][1], -0.5, 0.06);
    const Mechanics<2> begin = mechanics(model, run.samples.front()), end = mechanics(model, last);
    EXPECT_NEAR(end.energy(), begin.energy(), 2e-3);
    EXPECT_NEAR(begin.kinetic, 0.005, 1e-15);  // only the free mass
  }
}

TEST(SampledRun, EndsWhereNumbersDo) {
  Model<double, 2> model = two_masses(0.5);
  model.forces.edge_springs.forces[0].constant = 1e200;
  const SampledRun<2> run = run_plain(model, 0.5, 50);
  EXPECT_FALSE(run.finite);
  EXPECT_LT(run.samples.size(), 51u);
  for (const Sample<2>& sample : run.samples) EXPECT_TRUE(is_finite(sample));
}

TEST(OneStep, IsThatOfTheLeastForceRoundedDown) {
  Model<double, 2> model = two_masses(0.3);
  model.forces.edge_springs.add({{0, 1}, 1, 1, 0}, 0.07);
  EXPECT_EQ(least_step(model), 0.0625);
  scale_steps(model, 0.5);
  EXPECT_EQ(model.forces.edge_springs.steps, (std::vector<double>{0.15, 0.035}));
  set_steps(model, 0.25);
  EXPECT_EQ(model.forces.edge_springs.steps, (std::vector<double>{0.25, 0.25}));
}

integrator::Scene scene_of(const std::string& text) { return integrator::parse_scene(text, "test.json"); }

const MethodResult& method(const IntegratorResult& result, const std::string& name) {
  for (const MethodResult& m : result.methods) {
    if (m.method == name) return m;
  }
  throw std::out_of_range(name);
}

/// A chain in the plane with a stiffer middle.
std::string chain(const std::string& more) {
  return R"({"noli_scene": 1, "title": "chain", "dimension": 2, "duration": 0.4, "window": 0.1, "bodies": [
    {"name": "chain", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 6}}, "deform": {"stretch": [1.1, 1]},
     "velocity": [0.3, 0.2], "spin": 1, "material": {"edge_stiffness": 100, "mass_per_length": 1)" +
         more + R"(},
     "patches": [{"box": [[-0.2, -1], [0.2, 1]], "stiffness_factor": 100}]}]})";
}

TEST(IntegratorAudit, ConvergesToTheReferenceWithTheOrderOfEachMethod) {
  IntegratorOptions options;
  const IntegratorResult result = audit_integrator(scene_of(chain("")), options);
  EXPECT_TRUE(result.complete && result.plain && result.reference_finite);
  EXPECT_FALSE(result.has_finding());
  EXPECT_EQ(result.forces, 6u);
  ASSERT_EQ(result.methods.size(), 4u);
  for (const char* const name : {"own", "grouped", "verlet"}) {
    const auto& points = method(result, name).points;
    ASSERT_EQ(points.size(), 4u) << name;
    // Own steps do not divide each other, so the order shows over all halvings, not over a single one.
    EXPECT_NEAR(std::log2(points[0].errors.trajectory / points[3].errors.trajectory) / 3, 2, 0.3) << name;
    EXPECT_LT(points[3].errors.momentum, 1e-13) << name;
    EXPECT_LT(points[3].errors.angular_momentum, 1e-13) << name;
    EXPECT_GT(points[3].errors.trajectory, 10 * result.uncertainty.trajectory) << name;
    EXPECT_NEAR(static_cast<double>(points[3].events) / static_cast<double>(points[0].events), 8, 0.8) << name;
  }
  const auto& euler = method(result, "euler").points;
  ASSERT_GE(euler.size(), 2u);
  EXPECT_GT(euler.front().errors.trajectory, euler.back().errors.trajectory);
  EXPECT_GT(euler.back().errors.angular_momentum, 1e-6);  // not conserved
  EXPECT_LT(euler.back().errors.momentum, 1e-6);          // conserved, up to the solver's error
  EXPECT_LT(method(result, "grouped").points[0].events, method(result, "verlet").points[0].events);
}

TEST(IntegratorAudit, WhatAPlainLoopCannotDoTheIntegratorDoesWithOneStep) {
  IntegratorOptions options;
  options.halvings = 1;
  const IntegratorResult damped = audit_integrator(scene_of(chain(R"(, "damping": 0.01)")), options);
  EXPECT_FALSE(damped.plain);
  ASSERT_EQ(damped.methods.size(), 3u);  // without implicit Euler
  EXPECT_LT(method(damped, "verlet").points[1].errors.trajectory, 0.01);
}

TEST(IntegratorAudit, StepsThatAreTooLongAreAFinding) {
  std::string text = chain("");
  text.insert(1, R"("allow_unstable": true, "step_factor": 40, )");
  IntegratorOptions options;
  options.halvings = 0;
  options.windows = 1000;
  integrator::Scene scene = scene_of(text);
  scene.duration = 100;
  const IntegratorResult result = audit_integrator(scene, options);
  EXPECT_TRUE(result.has_finding());
}

TEST(IntegratorAudit, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  IntegratorOptions options;
  options.stop = &stop;
  EXPECT_FALSE(audit_integrator(scene_of(chain("")), options).complete);
}

TEST(IntegratorAudit, TheScenesForThoseWhoBringNoneAreScenes) {
  const auto texts = integrator_scenes();
  ASSERT_EQ(texts.size(), 2u);
  for (const std::string& text : texts) {
    const auto built = integrator::build_model<3>(scene_of(text));
    EXPECT_TRUE(plain_enough(built.model));
  }
}

}  // namespace
}  // namespace noli::audit
