// SPDX-License-Identifier: Apache-2.0
//
// Predicts scenes and summarises runs through the public interface.
#include <noli/explain.h>
#include <noli/simulate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <string_view>

#include <noli/errors.h>
#include "tests/support/temporary_folder.h"

namespace noli {
namespace {

/// A bar in the plane, which falls for four windows.
constexpr std::string_view falling_bar = R"({
  "noli_scene": 1, "title": "Bar", "dimension": 2, "duration": 0.04, "window": 0.01, "gravity": [0, -10],
  "gravity_step": 1e-3,
  "bodies": [{"name": "bar", "mesh": {"chain": {"points": [[0, 0], [1, 0]], "segments": 1}}, "steps": {"stretch": 1e-3},
              "material": {"edge_stiffness": 1, "mass_per_vertex": 1}}]})";

class ExplainInProcess : public testing::Test {
 protected:
  std::filesystem::path scene(std::string_view text = falling_bar) const { return folder.write("scene.json", text); }

  void simulate() const {
    SimulateRequest request;
    request.scene = scene();
    request.run = folder / "run";
    request.threads = 1;
    run_simulate(request);
  }

  test::TemporaryFolder folder;
};

TEST_F(ExplainInProcess, PredictsAScene) {
  const ScenePrediction prediction = prediction_of_scene(scene());
  EXPECT_EQ(prediction.title, "Bar");
  EXPECT_EQ(prediction.dimension, 2);
  ASSERT_EQ(prediction.bodies.size(), 1U);
  EXPECT_EQ(prediction.bodies[0].name, "bar");
  EXPECT_EQ(prediction.bodies[0].vertices, 2U);
  EXPECT_EQ(prediction.bodies[0].faces, 0U);
  EXPECT_EQ(prediction.bodies[0].edges, 1U);
  EXPECT_EQ(prediction.bodies[0].mass, 2);
  EXPECT_EQ(prediction.bodies[0].pinned, 0U);
  const auto spring = std::ranges::find(prediction.forces, ForceKind::edge_spring, &ForcesPrediction::kind);
  ASSERT_NE(spring, prediction.forces.end());
  EXPECT_EQ(spring->forces, 1U);
  EXPECT_EQ(spring->shortest, 0.01 / 16);  // the window's length, halved until it is at most the step that was given
  EXPECT_EQ(spring->longest, 0.01 / 16);
  EXPECT_NEAR(spring->events, 1600, 1e-6);
  EXPECT_TRUE(prediction.contact.empty());
  EXPECT_EQ(std::ranges::count(prediction.active, "gravity"), 1);
  EXPECT_EQ(std::ranges::count(prediction.left_out, "scripts: the scene has none"), 1);
  EXPECT_FALSE(prediction.defaults.empty());
  EXPECT_EQ(prediction.contact_at_start, "");
  EXPECT_EQ(prediction.windows, 4);
  EXPECT_GT(prediction.events_per_second, 1000);
  EXPECT_GT(prediction.breakpoints_per_second, 0);
  EXPECT_GT(prediction.bytes, 0);
}

TEST_F(ExplainInProcess, SaysWhatMeetsAtTheStart) {
  std::string crossed(falling_bar);
  crossed.replace(crossed.find("\"bodies\": ["), 11,
                  R"("bodies": [{"name": "post", "mesh": {"chain": {"points": [[0.5, -1], [0.5, 1]], "segments": 1}},
                     "steps": {"stretch": 1e-3}, "material": {"edge_stiffness": 1, "mass_per_vertex": 1}}, )");
  const ScenePrediction prediction = prediction_of_scene(scene(crossed));
  EXPECT_NE(prediction.contact_at_start.find("post"), std::string::npos) << prediction.contact_at_start;
  EXPECT_NE(prediction.contact_at_start.find("bar"), std::string::npos) << prediction.contact_at_start;
}

TEST_F(ExplainInProcess, ABadSceneIsAnInputError) {
  EXPECT_THROW(prediction_of_scene(scene("{}")), InputError);
  EXPECT_THROW(prediction_of_scene(folder / "none.json"), InputError);
}

TEST_F(ExplainInProcess, SummarisesARun) {
  simulate();
  const RunSummary summary = summary_of_run(folder / "run");
  EXPECT_EQ(summary.title, "Bar");
  EXPECT_EQ(summary.windows, 4U);
  EXPECT_EQ(summary.time, 0.04);
  ASSERT_TRUE(summary.energy);
  EXPECT_FALSE(summary.nearest);
  EXPECT_THROW(summary_of_run(folder / "none"), InputError);
}

TEST_F(ExplainInProcess, AStopOfItsOwnEndsIt) {
  const std::atomic<bool> stop = true, go_on = false;
  EXPECT_THROW(prediction_of_scene(scene(), false, &stop), Stopped);
  EXPECT_EQ(prediction_of_scene(scene(), false, &go_on).windows, 4);
  simulate();
  EXPECT_THROW(summary_of_run(folder / "run", &stop), Stopped);
  EXPECT_EQ(summary_of_run(folder / "run", &go_on).windows, 4U);
}

}  // namespace
}  // namespace noli
