// SPDX-License-Identifier: Apache-2.0
//
// Tests what `noli simulate` says of the energy of a run.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/runs/simulate_fixture.h"
#include "tests/support/temporary_folder.h"

namespace noli::app_tests {
namespace {

TEST_F(Simulate, EnergyThatGrowsWithoutEndIsSaidAtTheEnd) {
  const std::string file = (fs::path(NOLI_SOURCE_DIR) / "scenes/resonance.json").string();
  const Json json = json_of({"simulate", file, "-o", run_path("run")}, 1);
  EXPECT_EQ(json["verdict"], "unstable");
  EXPECT_EQ(json["end"], "unstable");
  EXPECT_EQ(json["windows"], json["windows_total"]);
  EXPECT_GT(json["energy"]["integration"], 0.01);
  const Json& astray = json["energy"]["astray"];
  EXPECT_GT(astray["there"], 100 * astray["begin"].get<double>());
  // All windows are committed and verified, and a run that was stopped halfway says the same.
  EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["verdict"], "proved");
  const std::string verified = run_noli({"verify", run_path("run"), "--junit", run_path("noli.xml")}).out;
  EXPECT_NE(verified.find(" s (no more was requested; its energy drifts).\n"), std::string::npos) << verified;
  EXPECT_NE(test::read_text(run_path("noli.xml")).find("<property name=\"run.end\" value=\"unstable\"/>"),
            std::string::npos);
  run_noli({"simulate", file, "-o", run_path("parts"), "--until", "54"});
  const Process resumed = run_noli({"simulate", file, "-o", run_path("parts"), "--resume"});
  EXPECT_EQ(resumed.exit_code, 1);
  EXPECT_NE(resumed.out.find("But the energy drifts: from 1e-12 J to "), std::string::npos) << resumed.out;
  EXPECT_EQ(json_of({"simulate", file, "-o", run_path("parts"), "--resume"}, 1)["energy"]["astray"], astray);
  // `noli explain` names the steps as soon as the scene does not accept them.
  EXPECT_NE(resumed.out.find("\nNext: remove \"allow_unstable\" from " + file + "; noli explain " + file +
                             " then names any step that is too long.\n"),
            std::string::npos)
      << resumed.out;
  Json strict = Json::parse(bytes_of(file));
  strict.erase("allow_unstable");
  const Process explained = run_noli({"explain", scene(strict)});
  EXPECT_EQ(explained.exit_code, 3);
  EXPECT_NE(explained.err.find("/steps/stretch: expected at most "), std::string::npos) << explained.err;
}

/// A sheet that oscillates in its plane.
Json damped_sheet(double damping) {
  Json json = Json::parse(R"({"noli_scene": 1, "title": "A sheet", "duration": 0.1, "bodies": [
    {"name": "sheet", "mesh": {"grid": {"size": [0.5, 0.5], "cells": [12, 12]}}, "perturb": 0.002,
     "material": {"young": 1e5, "density": 300, "thickness": 0.001}}]})");
  json["bodies"][0]["material"]["damping"] = damping;
  return json;
}

TEST_F(Simulate, StrongDampingTakesEnergyWithTheStepsThatNoliChooses) {
  const std::string file = scene(damped_sheet(0.1));
  EXPECT_NE(run_noli({"explain", file}).out.find("damping makes some steps of sheet "), std::string::npos);
  json_of({"simulate", file, "-o", run_path("run")}, 0);
  const Json run = json_of({"explain", run_path("run")}, 0);
  EXPECT_LT(run["energy"]["last"], 0.5 * run["energy"]["begin"].get<double>()) << run["energy"];
}

TEST_F(Simulate, StepsThatAreTooLongForDampingAreUnstable) {
  Json json = damped_sheet(0.1);
  json["bodies"][0]["steps"]["stretch"] = 3.125e-4;
  const std::string file = scene(json);
  const Process explained = run_noli({"explain", file});
  EXPECT_NE(explained.out.find("times too long for its damping"), std::string::npos) << explained.out;
  const std::string told = run_noli({"simulate", file, "-o", run_path("told")}).out;
  EXPECT_NE(told.find("\nNext: noli explain " + file + " says where steps are too long for the damping, or resonate;"),
            std::string::npos)
      << told;
  const Json result = json_of({"simulate", file, "-o", run_path("run")}, 1);
  EXPECT_EQ(result["verdict"], "unstable");
  EXPECT_GT(result["energy"]["astray"]["there"], result["energy"]["astray"]["begin"]);
}

TEST_F(Simulate, EnergyStaysWhereStepsAreStable) {
  Json json = beam(0.1);
  json["allow_unstable"] = true;
  const Json calm = json_of({"simulate", scene(json), "-o", run_path("calm")}, 0);
  EXPECT_EQ(calm["energy"]["astray"], nullptr);
  EXPECT_LE(std::abs(calm["energy"]["integration"].get<double>()), 1e-3);
}

}  // namespace
}  // namespace noli::app_tests
