// SPDX-License-Identifier: Apache-2.0
//
// Tests that friction holds bodies in place at default steps, that sliding follows Coulomb's law, and that the memory
// of friction is part of the motion's state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "running.h"

namespace noli::integrator {
namespace {

const std::string elastic = R"("material": {"young": 1e6, "poisson": 0.3, "density": 500, "thickness": 0.01,
                                            "damping": 0.001, "bending_damping": 0.001})";
const std::string rigid = R"("material": {"edge_stiffness": 0, "mass_per_area": 1})";

BuiltScene<3> built(const std::string& bodies, const std::string& rest) {
  const std::string text = R"({"noli_scene": 1, "window": 0.01, "bodies": [)" + bodies + "], " + rest + "}";
  return build_model<3>(parse_scene(text, "friction", Form::full));
}

/// A box on a level plane of cells x cells squares, with gravity tilted by atan 1/2. All steps are the defaults.
BuiltScene<3> box_on_an_incline(double friction, bool inclusion_exclusion = false, int cells = 1,
                                double stiffness = 2000) {
  const std::string count = std::to_string(cells);
  return built(R"({"name": "box", "mesh": {"box": {"size": [0.2, 0.2, 0.1], "cells": [2, 2, 1]}},
                   "transform": {"rotate": {"axis": [0, 0, 1], "degrees": 5}, "translate": [-0.3, -0.3, 0.0595]}, )" +
                   elastic + R"(}, {"name": "plane", "mesh": {"grid": {"size": [4, 2], "cells": [)" + count + ", " +
                   count + R"(]}}, "transform": {"translate": [1, 0, 0]}, "pin": ["all"], )" + rigid + "}",
               R"("duration": 4, "gravity": [4.387165, 0, -8.77433],
                  "contact": {"thickness": 0.01, "restitution": 0.25, "stiffness": )" +
                   std::to_string(stiffness) + R"(, "friction": )" + std::to_string(friction) +
                   R"(, "inclusion_exclusion": )" + (inclusion_exclusion ? "true}" : "false}"));
}

/// A box between two plates that close on it and hold it against gravity.
BuiltScene<3> gripped_box() {
  const auto plate = [](const char* name, double x) {
    return std::string(R"({"name": ")") + name +
           R"(", "mesh": {"grid": {"size": [0.3, 0.3], "cells": [1, 1]}},
              "transform": {"rotate": {"axis": [0, 1, 0], "degrees": 90}, "translate": [)" +
           std::to_string(x) + ", 0, 0]}, " + rigid + "}";
  };
  const auto script = [](const char* name, double move) {
    return std::string(R"({"body": ")") + name + R"(", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 0.1, "move": [)" +
           std::to_string(move) + ", 0, 0]}]}";
  };
  return built(R"({"name": "box", "mesh": {"box": {"size": [0.1, 0.1, 0.1], "cells": [1, 1, 1]}},
                   "transform": {"rotate": {"axis": [1, 0, 0], "degrees": 7}}, )" +
                   elastic + "}, " + plate("left", -0.0605) + ", " + plate("right", 0.0605),
               R"("duration": 4, "gravity": [0, 0, -9.81], "scripts": [)" + script("left", 0.004) + ", " +
                   script("right", -0.004) +
                   R"(], "contact": {"thickness": 0.01, "stiffness": 2000, "restitution": 0.25, "friction": 0.6,
                                     "exclude": [["left", "right"]]})");
}

/// Mean of a coordinate of the first body's vertices.
template <int Dim>
double mean_place(const Simulation<double, Dim>& simulation, std::size_t vertices, int axis) {
  const auto s = simulation.snapshot();
  double sum = 0;
  for (std::size_t i = 0; i < vertices; ++i) sum += s.x[i][axis];
  return sum / static_cast<double>(vertices);
}

/// The mean speed of the first body over a second, after a second of settling [m/s].
template <int Dim>
double creep(const BuiltScene<Dim>& scene, int axis) {
  Simulation<double, Dim> simulation(scene.model);
  test::run(simulation, 100);
  const double before = mean_place(simulation, scene.bodies[0].vertices, axis);
  test::run(simulation, 100);
  return mean_place(simulation, scene.bodies[0].vertices, axis) - before;
}

TEST(FrictionHolds, ABoxOnAnIncline) {
  for (const bool inclusion_exclusion : {false, true}) {
    const double speed = creep(box_on_an_incline(0.55, inclusion_exclusion), 0);
    std::printf("a box on an incline creeps %.3g mm/s%s\n", 1000 * speed,
                inclusion_exclusion ? " with inclusion and exclusion" : "");
    EXPECT_LT(std::abs(speed), 1e-5);
  }
  EXPECT_GT(creep(box_on_an_incline(0.45), 0), 0.1);
}

/// Where friction had less force between the kicks of elastic forces than just after them, these crept by 0.04 (7 x 7
/// squares), 0.66 (25 x 25) and 0.15 mm/s (25 x 25 with inclusion and exclusion).
TEST(FrictionHolds, ABoxOnAFloorOfManyCells) {
  for (const bool inclusion_exclusion : {false, true}) {
    for (const int cells : {7, 25}) {
      const double speed = creep(box_on_an_incline(0.55, inclusion_exclusion, cells), 0);
      std::printf("on %d x %d squares it creeps %.3g mm/s%s\n", cells, cells, 1000 * speed,
                  inclusion_exclusion ? " with inclusion and exclusion" : "");
      EXPECT_LT(std::abs(speed), 1e-5);
    }
  }
}

/// The box lies so deep in soft layers that several of them hold it, each with its own anchors.
TEST(FrictionHolds, ABoxInDeepLayers) {
  for (const double stiffness : {100, 20}) {
    const BuiltScene<3> scene = box_on_an_incline(0.55, false, 1, stiffness);
    const double speed = creep(scene, 0);
    Simulation<double, 3> simulation(scene.model);
    test::run(simulation, 50);
    const ContactSettings& contact = *scene.model.contact;
    std::uint32_t layers = 0;
    for (const Anchor<double>& anchor : simulation.snapshot().anchors) {
      const double step = layer_step(contact.materials[anchor.of.material], contact.schedule, anchor.of.layer);
      EXPECT_LE(anchor.until, simulation.time() + 1.5 * step) << "it outlives its layer " << anchor.of.layer;
      layers = std::max(layers, anchor.of.layer);
    }
    std::printf("with %g N/m it creeps %.3g mm/s, held by %d layers\n", stiffness, 1000 * speed,
                static_cast<int>(layers));
    EXPECT_GT(layers, 1U);
    EXPECT_LT(std::abs(speed), 1e-5);
  }
}

/// In the plane, an elastic frame. It crept by 1.4 mm/s.
TEST(FrictionHolds, AFrameInThePlane) {
  const std::string text = R"({"noli_scene": 1, "dimension": 2, "window": 0.01, "duration": 4,
      "gravity": [4.387165, -8.77433], "bodies": [
        {"name": "frame", "mesh": {"chain": {"points": [[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]], "segments": 12,
         "closed": true}}, "transform": {"translate": [-0.2, 0.0095]},
         "material": {"young": 1e7, "density": 500, "thickness": 0.01, "damping": 0.002}},
        {"name": "floor", "mesh": {"chain": {"points": [[-2, 0], [4, 0]], "segments": 1}}, "pin": ["all"],
         "material": {"edge_stiffness": 0, "mass_per_length": 1}}],
      "contact": {"thickness": 0.01, "restitution": 0.25, "friction": 0.55, "inclusion_exclusion": true}})";
  const BuiltScene<2> scene = build_model<2>(parse_scene(text, "friction", Form::full));
  const double speed = creep(scene, 0);
  std::printf("a frame in the plane creeps %.3g mm/s\n", 1000 * speed);
  EXPECT_LT(std::abs(speed), 1e-5);
}

/// A point that strikes a floor obliquely: friction takes 2 mu of the speed at which it came down, and no more than
/// there is. What it takes does not come back. Only slip that was stopped leaves anchors.
TEST(FrictionHolds, AnImpactStopsSlipAndDoesNotTurnIt) {
  for (const auto& [friction, left] : {std::pair{0.2, 0.6}, {0.6, 0.0}, {1.0, 0.0}, {10.0, 0.0}}) {
    const std::string text = R"({"noli_scene": 1, "dimension": 2, "window": 0.001, "duration": 1, "bodies": [
          {"mesh": {"points": {"at": [[0, 0.02]]}}, "velocity": [1, -1],
           "material": {"edge_stiffness": 0, "mass_per_vertex": 1}},
          {"mesh": {"chain": {"points": [[-2, 0], [4, 0]], "segments": 1}}, "pin": ["all"],
           "material": {"edge_stiffness": 0, "mass_per_length": 1}}],
        "contact": {"thickness": 0.01, "friction": )" +
                             std::to_string(friction) + "}}";
    const BuiltScene<2> scene = build_model<2>(parse_scene(text, "friction", Form::full));
    Simulation<double, 2> simulation(scene.model);
    bool anchored = false;
    for (int k = 0; k < 200; ++k) {
      test::run(simulation, 1);
      anchored |= !simulation.snapshot().anchors.empty();
    }
    EXPECT_EQ(anchored, left == 0) << friction;
    const Vec<double, 2> v = simulation.snapshot().v[0];
    EXPECT_NEAR(v[1], 1, 1e-3);
    EXPECT_NEAR(v[0], left, 2e-3) << friction;
  }
}

/// With restitution 0, a layer gives no impulse while bodies separate, but the anchor stays.
TEST(FrictionHolds, WhateverTheRestitution) {
  for (const double restitution : {0.0, 0.05, 1.0}) {
    BuiltScene<3> scene = box_on_an_incline(0.55);
    for (ContactMaterial& material : scene.model.contact->materials) material.restitution = restitution;
    const double speed = creep(scene, 0);
    std::printf("with a restitution of %.2f it creeps %.3g mm/s\n", restitution, 1000 * speed);
    EXPECT_LT(std::abs(speed), restitution < 1 ? 1e-5 : 1e-4);
  }
}

TEST(FrictionHolds, ABoxBetweenTwoPlates) {
  const double speed = creep(gripped_box(), 2);
  std::printf("a box between two plates creeps %.3g mm/s\n", 1000 * speed);
  EXPECT_LT(std::abs(speed), 1e-5);
}

// --- Part of the motion ----------------------------------------------------------------------------------------------

/// The state after `windows` windows of a simulation resumed from the snapshot of another one.
Snapshot<double, 3> gone_on(const Model<double, 3>& model, const Snapshot<double, 3>& from, std::uint64_t windows) {
  Simulation<double, 3> simulation(model, from);
  test::run(simulation, windows);
  return simulation.snapshot();
}

TEST(FrictionHolds, GoesOnFromASnapshotAsIfNothingHadHappened) {
  const BuiltScene<3> scene = box_on_an_incline(0.55, false, 1, 100);
  Simulation<double, 3> simulation(scene.model);
  test::run(simulation, 40);
  Snapshot<double, 3> half = simulation.snapshot();
  EXPECT_GE(half.anchors.size(), 8U);
  EXPECT_TRUE(std::ranges::any_of(half.anchors, [](const auto& anchor) { return anchor.of.layer > 1; }));
  test::run(simulation, 10);
  test::expect_same(gone_on(scene.model, half, 10), simulation.snapshot());
  EXPECT_EQ(gone_on(scene.model, half, 10).anchors, simulation.snapshot().anchors);
  half.anchors.clear();
  EXPECT_NE(gone_on(scene.model, half, 10).x, simulation.snapshot().x);
}

TEST(FrictionHolds, LayersActivatedInTimeEqualLayersThatAlwaysAre) {
  BuiltScene<3> scene = box_on_an_incline(0.55, false, 1, 100);
  Simulation<double, 3> lazy(scene.model);
  scene.model.contact->least_layers = 10;
  Simulation<double, 3> eager(scene.model);
  test::run(lazy, 20);
  test::run(eager, 20);
  test::expect_same(lazy.snapshot(), eager.snapshot());
  EXPECT_EQ(lazy.snapshot().anchors, eager.snapshot().anchors);
}

/// A plate and a box that slips on it, both free.
TEST(FrictionHolds, KeepsBothMomenta) {
  const BuiltScene<3> scene = built(
      R"({"name": "box", "mesh": {"box": {"size": [0.1, 0.1, 0.1], "cells": [1, 1, 1]}}, "velocity": [0.3, 0.1, -0.5],
                "transform": {"rotate": {"axis": [0, 0, 1], "degrees": 7}, "translate": [0, 0, 0.07]}, )" +
          elastic + R"(}, {"name": "plate", "mesh": {"grid": {"size": [0.4, 0.4], "cells": [2, 2]}}, )" + elastic + "}",
      R"("duration": 4, "contact": {"thickness": 0.01, "stiffness": 2000, "restitution": 0.25, "friction": 0.4})");
  Simulation<double, 3> simulation(scene.model);
  const auto before = simulation.state();
  const auto books = test::run(simulation, 20);
  const auto after = simulation.state();
  EXPECT_LT(books.of(ForceKind::contact).damping_work, -1e-4) << "it rubs";
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13 * before.speeds);
  EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), 1e-12 * before.moments);
}

}  // namespace
}  // namespace noli::integrator
