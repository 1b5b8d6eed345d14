// SPDX-License-Identifier: Apache-2.0
//
// Tests that a vertex is planned rarely even if it is struck again and again.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "running.h"

namespace noli::integrator {
namespace {

using Json = nlohmann::json;

/// Balls against sheets at 100 m/s, with a short step of gravity.
Json beads_and_sheets() {
  return Json::parse(R"({
    "noli_scene": 1, "title": "beads", "duration": 1, "window": 0.001, "record": "frames",
    "gravity": [0, 0, -9.81], "gravity_step": 6.2e-5,
    "bodies": [
      {"name": "sheets", "mesh": {"grid": {"size": [0.1, 0.1], "cells": [6, 6]}}, "perturb": 1e-4,
       "array": {"counts": [1, 1, 3], "spacing": [0, 0, 0.02]},
       "material": {"young": 1e6, "poisson": 0.3, "density": 200, "thickness": 0.001, "bending": 20}},
      {"name": "beads", "mesh": {"sphere": {"radius": 0.012, "subdivisions": 1}}, "velocity": [0, 0, -100],
       "transform": {"translate": [-0.02, -0.01, 0.065]}, "array": {"counts": [2, 1, 1], "spacing": [0.04, 0, 0]},
       "material": {"young": 1e7, "poisson": 0.3, "density": 2000, "thickness": 0.004, "bending": 100}}],
    "contact": {"thickness": 0.002, "stiffness": 1000, "restitution": 0.3}})");
}

/// Three sheets pressed together by two plates: after 36 ms the plates are 6.7 mm apart.
Json pinched_sheets() {
  return Json::parse(R"({
    "noli_scene": 1, "title": "pinched", "duration": 1, "window": 0.002, "record": "frames",
    "bodies": [
      {"name": "sheets", "mesh": {"grid": {"size": [0.1, 0.1], "cells": [6, 6]}}, "perturb": 1e-4,
       "array": {"counts": [1, 1, 3], "spacing": [0, 0, 0.01]},
       "material": {"young": 1e6, "poisson": 0.3, "density": 200, "thickness": 0.001, "bending": 20}},
      {"name": "below", "mesh": {"grid": {"size": [0.04, 0.04], "cells": [2, 2]}},
       "transform": {"translate": [0.003, 0.002, -0.01]}, "material": {"edge_stiffness": 0, "mass_per_area": 1}},
      {"name": "above", "mesh": {"grid": {"size": [0.04, 0.04], "cells": [2, 2]}},
       "transform": {"translate": [0.003, 0.002, 0.03]}, "material": {"edge_stiffness": 0, "mass_per_area": 1}}],
    "scripts": [
      {"body": "below", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 0.04, "move": [0, 0, 0.0185]}]},
      {"body": "above", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 0.04, "move": [0, 0, -0.0185]}]}],
    "contact": {"thickness": 0.003, "stiffness": 1000, "restitution": 0.3}})");
}

void expect_few_plans(const Json& scene, std::uint64_t windows, std::uint64_t impulses_a_plan) {
  Simulation<double, 3> simulation(build_model<3>(parse_scene(scene.dump(), "scene.json")).model);
  const auto books = test::run(simulation, windows);
  const CertificateCounts c = simulation.certificates();
  const std::uint64_t impulses = books.of(ForceKind::contact).events;
  std::printf("%g plans, %g repairs, %g activations, %g impulses\n", static_cast<double>(c.plans),
              static_cast<double>(c.repairs), static_cast<double>(c.activations), static_cast<double>(impulses));
  ASSERT_GT(impulses, 100'000U);
  EXPECT_LT(impulses_a_plan * c.plans, impulses);
}

TEST(FewPlans, AtHighSpeed) { expect_few_plans(beads_and_sheets(), 1, 7); }     // 7.9 found
TEST(FewPlans, BetweenPlates) { expect_few_plans(pinched_sheets(), 18, 250); }  // 302 found

}  // namespace
}  // namespace noli::integrator
