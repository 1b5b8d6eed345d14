// SPDX-License-Identifier: Apache-2.0
//
// Tests scenes with contact forces with the `noli` command.
#include <gtest/gtest.h>

#include "tests/app/runs/killer.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/kernel/random_numbers.h"

namespace noli::app_tests {
namespace {

TEST_F(Simulate, ContactKeepsThingsApart) {
  const Json json = json_of({"simulate", scene(two_cloths()), "-o", run_path("run")}, 0);
  EXPECT_EQ(json["verdict"], "no_contact");
  EXPECT_EQ(json["windows"], 20);
  EXPECT_EQ(json["roll_backs"], 0);
  EXPECT_EQ(json["too_near"], nullptr);
  EXPECT_GE(json["timing"]["certificates"]["deepest"], 1);
  EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["verdict"], "proved");
  // Without contact forces they do meet.
  Json bare = two_cloths();
  bare.erase("contact");
  EXPECT_EQ(json_of({"simulate", scene(bare), "-o", run_path("bare")}, 1)["verdict"], "contact");
}

TEST_F(Simulate, ContactGivesTheSameBytesWhateverInterruptsIt) {
  const std::string file = scene(two_cloths());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("whole")}).exit_code, 0);
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("one"), "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("parts"), "--until", "0.03"}).exit_code, 0);
  for (const char* until : {"0.07", "0.12", "0.2"}) {
    ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("parts"), "--resume", "--until", until}).exit_code, 0);
  }
  const std::string bytes = bytes_of(run_path("whole/trajectory.blocks"));
  EXPECT_EQ(bytes, bytes_of(run_path("one/trajectory.blocks")));
  EXPECT_EQ(bytes, bytes_of(run_path("parts/trajectory.blocks")));
  const Process again =
      run_noli({"simulate", file, "--reproduce", run_path("whole"), "--window", "9", "-o", run_path("window-9.block")});
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

class KilledScene : public Simulate, public testing::WithParamInterface<const char*> {};

TEST_P(KilledScene, SlowHasTheSameBytesAfterAHundredKills) {
  const std::string file = (fs::path(NOLI_SOURCE_DIR) / "scenes" / GetParam()).string();
  ASSERT_EQ(run_noli({"simulate", file, "--short", "-o", run_path("whole")}).exit_code, 0);
  test::Random random(1);
  const auto pause = [&] { return std::chrono::milliseconds(100 + random.below(500)); };
  int kills = 0;
  while (kills < 100) {
    const int more = kill_until_done({file, "--short"}, run_path("killed"), 100 - kills, pause);
    ASSERT_GE(more, 0);
    kills += more;
    ASSERT_TRUE(blocks("killed") == blocks("whole"));
    fs::remove_all(run_path("killed"));
  }
}

INSTANTIATE_TEST_SUITE_P(All, KilledScene, testing::Values("bowline.json", "curtains.json", "reef_knot.json"));

TEST_F(Simulate, WhatASceneExcludesPassesThroughAndIsPartOfTheStatement) {
  Json json = two_cloths();
  json["contact"]["exclude"] = Json::array({Json::array({"falling", "lying"})});
  const Json result = json_of({"simulate", scene(json), "-o", run_path("run")}, 0);
  EXPECT_EQ(result["verdict"], "no_contact");
  EXPECT_EQ(result["excluded"], Json::parse(R"([["falling", "lying"]])"));
  EXPECT_NE(result["statement"].get<std::string>().find("two cells of falling and lying"), std::string::npos);
  EXPECT_EQ(result["timing"]["certificates"]["deepest"], 0);
  const Json verified = json_of({"verify", run_path("run")}, 0);
  EXPECT_EQ(verified["statement"]["excluded"][1], "two cells of falling and lying, which the run's scene excludes");
  const Process told = run_noli({"verify", run_path("run")});
  EXPECT_NE(told.out.find("; two cells of falling and lying (excluded) ("), std::string::npos) << told.out;
  // A third cloth is not excluded.
  json["bodies"].push_back(json["bodies"][1]);
  json["bodies"][2]["name"] = "third";
  json["bodies"][2]["transform"]["translate"] = {0, 0, -0.1};
  const Json third = json_of({"simulate", scene(json), "-o", run_path("third")}, 0);
  EXPECT_GE(third["timing"]["certificates"]["deepest"], 1);
}

TEST_F(Simulate, AGapWithinAllLayersAtTheStartIsTold) {
  Json json = {{"noli_scene", 1}, {"dimension", 2}, {"duration", 1}, {"window", 0.01}};
  json["bodies"] = Json::parse(R"([
      {"name": "floor", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}}, "pin": ["all"],
       "material": {"edge_stiffness": 0, "mass_per_length": 1}},
      {"name": "point", "mesh": {"points": {"at": [[0.1, 0.0078125]]}},
       "material": {"edge_stiffness": 0, "mass_per_vertex": 1}}])");
  json["contact"] = {{"thickness", 0.1}, {"stiffness", 100}, {"most_layers", 16}};
  const std::string file = scene(json);
  const Json result = json_of({"simulate", file, "-o", run_path("run")}, 1);
  EXPECT_EQ(result["verdict"], "too_near");
  EXPECT_EQ(result["too_near"]["time"], 0);
  EXPECT_EQ(result["too_near"]["start"]["gap"], 0.0078125);
  EXPECT_EQ(result["too_near"]["start"]["thickness"], 0.1);
  EXPECT_GT(result["too_near"]["start"]["last_thickness"], 0.0078125);
  const Process told = run_noli({"simulate", file, "-o", run_path("told")});
  EXPECT_NE(told.out.find("Too near at the start: vertex point[0] and edge floor[0]-floor[1] need more layers"),
            std::string::npos)
      << told.out;
  EXPECT_NE(told.out.find("the scene begins with them 0.0078125 m apart, within the thickness of contact, 0.1 m"),
            std::string::npos)
      << told.out;
  EXPECT_NE(told.out.find("\nNext: let them begin further apart in " + file + ", or lower \"thickness\""),
            std::string::npos)
      << told.out;
  // At half this depth in the first layer, there is enough space.
  json["bodies"][1]["mesh"]["points"]["at"][0][1] = 0.09;
  EXPECT_EQ(json_of({"simulate", scene(json), "-o", run_path("far")}, 0)["too_near"], nullptr);
}

/// In the plane: a point between a floor and an edge that a script puts onto it.
TEST_F(Simulate, APointThatIsPinchedToNothingEndsTheRun) {
  const Json wall = {{"chain", {{"points", {{-1, 0}, {1, 0}}}, {"segments", 1}}}};
  const Json stiff = {{"edge_stiffness", 0}, {"mass_per_length", 1}};
  const Json json = {
      {"noli_scene", 1},
      {"title", "Pinched"},
      {"dimension", 2},
      {"duration", 2},
      {"window", 0.01},
      {"bodies",
       {{{"name", "floor"}, {"mesh", wall}, {"material", stiff}, {"pin", {"all"}}},
        {{"name", "press"}, {"mesh", wall}, {"transform", {{"translate", {0, 1}}}}, {"material", stiff}},
        {{"name", "point"},
         {"mesh", Json::parse(R"({"points": {"at": [[0.1, 0.5]]}})")},
         {"material", {{"edge_stiffness", 0}, {"mass_per_vertex", 1}}}}}},
      {"scripts", {{{"body", "press"}, {"path", {{{"t", 0}, {"move", {0, 0}}}, {{"t", 1}, {"move", {0, -1}}}}}}}},
      {"contact", {{"thickness", 0.1}, {"stiffness", 100}, {"most_layers", 200}}}};
  const Json result = json_of({"simulate", scene(json), "-o", run_path("run")}, 1);
  EXPECT_EQ(result["verdict"], "too_near");
  EXPECT_EQ(result["end"], "too_near");
  EXPECT_EQ(result["too_near"]["pair"], "vertex_edge");
  EXPECT_GT(result["too_near"]["time"], 0.9);
  EXPECT_LT(result["too_near"]["time"], 1);
  EXPECT_EQ(result["too_near"]["names"], "vertex point[0] and edge press[0]-press[1]");
  EXPECT_EQ(result["too_near"]["start"], nullptr);
  const std::string told = run_noli({"simulate", scene(json), "-o", run_path("told")}).out;
  EXPECT_NE(told.find("\nNext: raise \"stiffness\" or \"thickness\" in \"contact\" of "), std::string::npos) << told;
  EXPECT_NE(told.find("; where scripts press things together, leave a gap.\n"), std::string::npos) << told;
  EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["verdict"], "proved");
  EXPECT_NE(run_noli({"verify", run_path("run")}).out.find(" s of 2 s (too near).\n"), std::string::npos);
}

}  // namespace
}  // namespace noli::app_tests
