// SPDX-License-Identifier: Apache-2.0
//
// Runs scenes in MPFR: with 53 bits they equal double, bit for bit; with other precisions they differ.
#include "audit/numerics/precision.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "integrator/simulation.h"
#include "trajectory/stop.h"

namespace noli::audit {
namespace {

using integrator::Scene;

Scene shipped(const std::string& name) {
  return integrator::read_scene(std::string(NOLI_SOURCE_DIR) + "/scenes/" + name + ".json", integrator::Form::brief);
}

/// A scene with these bodies; `rest` holds its other members.
Scene written(const std::string& bodies, const std::string& rest) {
  return integrator::parse_scene(R"({"noli_scene": 1, "bodies": [)" + bodies + "]," + rest + "}", "test.json");
}

/// A small sheet falls onto a corner of a plate in space: contact of faces and of edges, restitution, friction.
Scene falling_sheet(const std::string& steps, bool inclusion_exclusion = false) {
  return written(
      R"({"name": "sheet", "mesh": {"grid": {"size": [0.1, 0.1], "cells": [3, 3]}},
          "transform": {"rotate": {"axis": [1, 2, 0], "degrees": 20}, "translate": [0.01, 0.02, 0.03]},
          "velocity": [0.5, 0.2, -3],
          "material": {"young": 1e5, "density": 1000, "thickness": 0.001, "damping": 0.001}},
         {"name": "plate", "mesh": {"grid": {"size": [0.06, 0.06], "cells": [2, 2]}}, "pin": ["all"],
          "transform": {"translate": [0.03, 0.03, 0]},
          "material": {"young": 1e5, "density": 1000, "thickness": 0.001}})",
      R"("duration": 0.02, "window": 0.002, "gravity": [0, 0, -9.81], "steps": ")" + steps +
          R"(", "contact": {"thickness": 0.003, "restitution": 0.5, "friction": 0.4, "inclusion_exclusion": )" +
          (inclusion_exclusion ? "true}" : "false}"));
}

/// Two elastic discs in a small box: runs that begin close to each other diverge within half a second.
Scene discs() {
  const std::string material =
      R"("material": {"edge_stiffness": 2000, "bending_stiffness": 0.01, "mass_per_vertex": 0.001})";
  return written(
      R"({"mesh": {"ring": {"radius": 0.05, "segments": 5}}, "velocity": [4, 2.3], )" + material + "}," +
          R"({"mesh": {"ring": {"radius": 0.05, "segments": 5}}, "transform": {"translate": [0.2, 0.03]},
              "velocity": [-3, 1], )" +
          material + "}," +
          R"({"mesh": {"chain": {"points": [[-0.1, -0.1], [0.3, -0.1], [0.3, 0.1], [-0.1, 0.1]], "segments": 4,
              "closed": true}}, "material": {"edge_stiffness": 0, "mass_per_length": 1}, "pin": ["all"]})",
      R"("dimension": 2, "duration": 1, "window": 0.01, "contact": {"thickness": 0.01, "stiffness": 500})");
}

PrecisionOutcome audit(const Scene& scene, std::uint64_t windows, const std::vector<Arithmetic>& arithmetics,
                       int threads = 1) {
  PrecisionRequest request;
  request.arithmetics = arithmetics;
  request.windows = windows;
  request.threads = threads;
  if (scene.dimension == 2) return audit_precision(integrator::build_model<2>(scene).model, request);
  return audit_precision(integrator::build_model<3>(scene).model, request);
}

void expect_same(const PrecisionOutcome& outcome) {
  EXPECT_FALSE(outcome.difference) << outcome.difference->what << " at " << outcome.difference->time;
  EXPECT_TRUE(outcome.complete);
  const PrecisionRun& first = outcome.runs.front();
  ASSERT_EQ(first.drifts.size(), outcome.windows);
  for (const Drift& drift : first.drifts) {
    EXPECT_EQ(drift.position, 0);
    EXPECT_EQ(drift.energy, 0);
    EXPECT_EQ(drift.angular_momentum, 0);
  }
  for (const auto* way : {&first.changes.acts, &first.changes.parts, &first.changes.sticks, &first.changes.corners}) {
    EXPECT_EQ(way->count, 0U);
  }
}

/// Expects that 53 bits equal double, and that 52 and 54 bits do not.
void expect_only_double_is_double(const Scene& scene, std::uint64_t windows) {
  expect_same(audit(scene, windows, {hardware_double}));
  for (const int bits : {52, 54}) {
    const PrecisionOutcome outcome = audit(scene, windows, {{bits, true}});
    ASSERT_TRUE(outcome.difference) << bits;
    EXPECT_GT(outcome.runs.front().drifts.back().position, 0) << bits;
  }
}

TEST(PrecisionAudit, FiftyThreeBitsAreDoubleWithoutContact) {
  expect_only_double_is_double(shipped("hanging_chain"), 4);
  expect_only_double_is_double(shipped("twisted_rod"), 1);
}

TEST(PrecisionAudit, FiftyThreeBitsAreDoubleWithContactInThePlane) {
  const PrecisionOutcome outcome = audit(shipped("bounce"), 60, {hardware_double});
  expect_same(outcome);
  EXPECT_GT(outcome.impulses, 100U);
  expect_only_double_is_double(shipped("bounce"), 12);
  expect_same(audit(discs(), 10, {hardware_double}));
}

/// Resting bodies are struck from the start, and gravity acts on them in neither run.
TEST(PrecisionAudit, FiftyThreeBitsAreDoubleWhereARunBeginsInContact) {
  const Scene scene = written(
      R"({"mesh": {"points": {"at": [[0, 0.09]]}}, "material": {"edge_stiffness": 0, "mass_per_vertex": 1}},
         {"mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}}, "pin": ["all"],
          "material": {"edge_stiffness": 0, "mass_per_length": 1}})",
      R"("dimension": 2, "duration": 0.1, "window": 0.01, "gravity": [0, -9.8],
         "contact": {"thickness": 0.1, "stiffness": 1000})");
  const PrecisionOutcome outcome = audit(scene, 10, {hardware_double});
  expect_same(outcome);
  EXPECT_GT(outcome.impulses, 50U);
}

TEST(PrecisionAudit, FiftyThreeBitsAreDoubleWithContactInSpace) {
  for (const char* const steps : {"grouped", "own"}) {
    const PrecisionOutcome outcome = audit(falling_sheet(steps), 8, {hardware_double});
    expect_same(outcome);
    EXPECT_GT(outcome.impulses, 100U) << steps;
    EXPECT_TRUE(audit(falling_sheet(steps), 8, {{52, true}}).difference) << steps;
  }
}

TEST(PrecisionAudit, FiftyThreeBitsAreDoubleWithInclusionAndExclusion) {
  const PrecisionOutcome outcome = audit(falling_sheet("grouped", true), 8, {hardware_double});
  expect_same(outcome);
  EXPECT_GT(outcome.impulses, 100U);
  EXPECT_TRUE(audit(falling_sheet("grouped", true), 8, {{52, true}}).difference);
}

TEST(PrecisionAudit, FiftyThreeBitsAreDoubleInShippedScenesSlow) {
  for (const char* const name : {"swinging_cloth", "restitution", "plane_nails", "twisted_rod", "incline", "stack"}) {
    SCOPED_TRACE(name);
    const Scene scene = shipped(name);
    expect_same(
        audit(scene, static_cast<std::uint64_t>(std::min(20.0, scene.duration / scene.window)), {hardware_double}, 2));
  }
}

/// The audit's run in double equals the run of `noli simulate`.
template <int Dim>
void expect_energies_of_simulation(const Scene& scene, std::uint64_t windows) {
  const auto model = integrator::build_model<Dim>(scene).model;
  PrecisionRequest request;
  request.windows = windows;
  const PrecisionOutcome outcome = audit_precision(model, request);
  integrator::Simulation<double, Dim> simulation(model);
  for (std::uint64_t i = 0; i < windows; ++i) {
    integrator::Books<double, Dim> books;
    simulation.run_window(books);
    const auto state = simulation.state();
    EXPECT_NEAR(outcome.energies[i].energy, state.kinetic_mean + state.potential_sum(), 1e-14) << i;
    EXPECT_EQ(outcome.energies[i].time, simulation.time());
  }
  EXPECT_EQ(outcome.events, simulation.events());
}

TEST(PrecisionAudit, DoubleIsTheSimulation) {
  expect_energies_of_simulation<2>(discs(), 8);
  expect_energies_of_simulation<3>(falling_sheet("grouped"), 8);
}

TEST(PrecisionAudit, DriftsConvergeWithThePrecision) {
  const PrecisionOutcome outcome =
      audit(shipped("hanging_chain"), 4, {hardware_double, {64, false}, {113, false}, {256, false}});
  std::array<double, 4> position{};
  for (std::size_t i = 0; i < 4; ++i) position[i] = outcome.runs[i].drifts.back().position;
  EXPECT_GT(position[3], 1e-18);
  EXPECT_LT(position[3], 1e-13);
  // The drift measured against 64 bits is off by some thousandths, that against 113 bits by too little to show.
  EXPECT_NEAR(position[1], position[3], 1e-2 * position[3]);
  EXPECT_NE(position[1], position[3]);
  EXPECT_NEAR(position[2], position[3], 1e-12 * position[3]);
}

TEST(PrecisionAudit, TruncationFallsWithTheSteps) {
  std::array<double, 2> truncation{}, rounding{};
  for (const std::size_t i : {0U, 1U}) {
    Scene scene = shipped("hanging_chain");
    scene.step_factor = i == 0 ? 0.125 : 0.03125;
    const PrecisionOutcome outcome = audit(scene, 4, {hardware_double, {128, false}});
    truncation[i] = std::abs(outcome.energies.back().truncation);
    rounding[i] = std::abs(outcome.energies.back().rounding);
    EXPECT_LT(outcome.energies.back().share_of_rounding(), 1e-6);
  }
  EXPECT_LT(truncation[1], 0.1 * truncation[0]) << "a sixteenth of it, with steps of a quarter";
  EXPECT_LT(rounding[0] + rounding[1], 1e-11);
}

TEST(PrecisionAudit, SaysWhenTheOrderOfEventsChanges) {
  const PrecisionOutcome outcome = audit(discs(), 8, {hardware_double, {256, false}});
  expect_same(audit(discs(), 8, {hardware_double}));
  EXPECT_FALSE(outcome.difference);
  const auto& acts = outcome.runs.back().changes.acts;
  ASSERT_TRUE(acts.first);
  EXPECT_LE(outcome.order_changes(), acts.first->time);
  const std::size_t windows = outcome.windows_in_order();
  ASSERT_GT(windows, 2U);
  ASSERT_LT(windows, 8U);
  EXPECT_LT(outcome.energies[windows - 1].time, acts.first->time);
  EXPECT_GE(outcome.energies[windows].time, acts.first->time);
  // Before that, the difference is a drift; afterwards the runs follow different motions.
  EXPECT_LT(outcome.runs.back().drifts[windows - 1].position, 1e-3 * outcome.extent);
  EXPECT_GT(outcome.runs.back().drifts.back().position, 0.1 * outcome.extent);
}

/// The energy that scripts and restitution add or remove is booked, so it does not count as truncation error.
TEST(PrecisionAudit, TellsTruncationWhereScriptsAndRestitutionWork) {
  const std::vector<Arithmetic> arithmetics = {hardware_double, {128, false}};
  const PrecisionOutcome pulled = audit(shipped("sheet_through_sheet"), 4, arithmetics),
                         bounced = audit(shipped("restitution"), 16, arithmetics);
  EXPECT_LT(std::abs(pulled.energies.back().truncation), 0.05 * std::abs(pulled.energies.back().energy));
  EXPECT_LT(std::abs(bounced.energies.back().truncation), 0.01 * std::abs(bounced.energies.back().energy));
  EXPECT_FALSE(pulled.difference);
  EXPECT_FALSE(bounced.difference);
}

TEST(PrecisionAudit, ThreadsChangeNothing) {
  const std::vector<Arithmetic> arithmetics = {hardware_double, {64, false}, {113, false}, {256, false}};
  const PrecisionOutcome one = audit(falling_sheet("grouped"), 5, arithmetics, 1),
                         four = audit(falling_sheet("grouped"), 5, arithmetics, 4);
  for (std::size_t i = 0; i < arithmetics.size(); ++i) {
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_EQ(one.runs[i].drifts[k].position, four.runs[i].drifts[k].position);
      EXPECT_EQ(one.runs[i].drifts[k].energy, four.runs[i].drifts[k].energy);
    }
  }
}

TEST(PrecisionAudit, EndsWhereTheRunInDoubleDoes) {
  const auto scene = [](const char* speed) {
    return written(R"({"mesh": {"points": {"at": [[0, 0.2]]}}, "velocity": [0, )" + std::string(speed) +
                       R"(], "material": {"edge_stiffness": 0, "mass_per_vertex": 1}},
                      {"mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}}, "pin": ["all"],
                       "material": {"edge_stiffness": 0, "mass_per_length": 1}})",
                   R"("dimension": 2, "duration": 1, "window": 0.01,
           "contact": {"thickness": 0.01, "stiffness": 1, "most_layers": 3})");
  };
  const PrecisionOutcome outcome = audit(scene("-10"), 20, {hardware_double});
  EXPECT_EQ(outcome.ended, "a pair of features needs more layers of contact than allowed");
  EXPECT_FALSE(outcome.complete);
  EXPECT_EQ(outcome.runs.front().drifts.size(), outcome.windows);
  EXPECT_FALSE(audit(scene("-0.001"), 20, {hardware_double}).ended);
}

TEST(PrecisionAudit, StopsWhenToldTo) {
  const auto model = integrator::build_model<2>(shipped("bounce")).model;
  const std::atomic<bool> stop = true;
  PrecisionRequest request;
  request.windows = 10;
  request.stop = &stop;
  const PrecisionOutcome outcome = audit_precision(model, request);
  EXPECT_EQ(outcome.windows, 0U);
  EXPECT_FALSE(outcome.complete);
}

/// Within a window only the search for what is near hears such a stop. Windows that were run to their end stay.
TEST(PrecisionAudit, KeepsItsWindowsWhereASearchIsStopped) {
  const auto model = integrator::build_model<2>(discs()).model;
  std::atomic<bool> stop = false;
  const StopOfThread heard(stop);
  PrecisionRequest request;
  request.windows = 20;
  request.progress = [&](double /*share*/) { stop = true; };
  const PrecisionOutcome outcome = audit_precision(model, request);
  EXPECT_GE(outcome.windows, 1U);
  EXPECT_LT(outcome.windows, 20U);
  EXPECT_FALSE(outcome.complete);
  EXPECT_EQ(outcome.runs.front().drifts.size(), outcome.windows);
}

TEST(PrecisionAudit, RefusesPrecisionsThatAreNone) {
  const auto model = integrator::build_model<2>(shipped("bounce")).model;
  PrecisionRequest request;
  for (const int bits : {0, 1, 1025}) {
    request.arithmetics = {{bits, false}};
    EXPECT_THROW(audit_precision(model, request), std::invalid_argument) << bits;
  }
  request.arithmetics = {};
  EXPECT_THROW(audit_precision(model, request), std::invalid_argument);
}

}  // namespace
}  // namespace noli::audit
