// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli explain RUN`: what happened, from the files of a run alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/app/runs/simulate_fixture.h"
#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {
namespace {

double sum(const Json& numbers) {
  double total = 0;
  for (const auto& x : numbers) total += x.get<double>();
  return total;
}

/// The least height of a point. Its height is piecewise linear, so the minimum is at a breakpoint.
double least_height(const std::string& run, VertexId point) {
  RunReader reader(run);
  double least = std::numeric_limits<double>::infinity();
  while (const auto window = reader.next_window()) {
    for (const Position& x : window->lines->positions(point)) least = std::min(least, x[1]);
  }
  return least;
}

TEST_F(Simulate, ExplainTellsHowNearThingsCameExactly) {
  ASSERT_EQ(run_noli({"simulate", scene(bouncing_point()), "-o", run_path("run")}).exit_code, 0);
  const Json json = json_of({"explain", run_path("run")}, 0);
  EXPECT_EQ(json["verdict"], "explained");
  EXPECT_EQ(json["windows"], 16);
  const double least = least_height(run_path("run"), 2);
  EXPECT_EQ(json["gap"]["up_to"], least);
  EXPECT_EQ(json["gap"]["above"], std::nextafter(least, 0));
  EXPECT_GT(json["timing"]["bound"], 0);
  EXPECT_LT(json["timing"]["bound"], least);
  EXPECT_GE(json["deepest"]["layer"], 1);
  EXPECT_EQ(json["deepest"]["names"], "vertex ball[0] and edge floor[0]-floor[1]");
  EXPECT_EQ(json["nearest"]["pair"], "vertex_edge");
  EXPECT_NEAR(json["nearest"]["distance"].get<double>(), least, 1e-12);
  const double layer = json["deepest"]["layer"];
  EXPECT_EQ(json["layer_cap"]["most_layers"], 400);
  EXPECT_EQ(json["layer_cap"]["worst"][0]["layer"], layer);
  EXPECT_GT(json["events"]["contact"], 0);
  EXPECT_EQ(json["events"]["hinge"], 0);
  EXPECT_EQ(json["events_a_second"]["contact"], json["events"]["contact"]);  // the run takes one second
}

TEST_F(Simulate, ExplainAddsUpPhasesOfAllParts) {
  Json cloths = two_cloths();
  cloths["duration"] = 2;
  const std::string file = scene(cloths);
  const Json first = json_of({"simulate", file, "-o", run_path("run"), "--until", "0.1"}, 0);
  EXPECT_GE(sum(first["timing"]["phases"]) + 1e-6, first["timing"]["simulating_seconds"].get<double>());
  EXPECT_LE(sum(first["timing"]["phases"]), first["timing"]["seconds"].get<double>() + 1e-6);
  const Json second = json_of({"simulate", file, "-o", run_path("run"), "--resume"}, 0);
  const Json json = json_of({"explain", run_path("run")}, 0);
  EXPECT_EQ(json["timing"]["parts"], 2);
  EXPECT_EQ(json["timing"]["parts_ended"], 2);
  EXPECT_NEAR(sum(json["timing"]["phases"]), sum(first["timing"]["phases"]) + sum(second["timing"]["phases"]), 1e-9);
  const Json& phases = json["timing"]["phases"];
  // The clock may miss any one phase (certify/simulate/phase_clock.h), but not all.
  EXPECT_GT(sum(phases) - phases["other"].get<double>(), 0);
  const Json& certificates = json["timing"]["certificates"];
  EXPECT_GT(certificates["plans"], 0);
  EXPECT_GT(certificates["events"], 0);
  const double activations = certificates["activations"];
  const std::string said = fmt::format(
      "For each layer that was activated: {:.3g} plans, {:.3g} repairs, {:.3g} events of certificates.",
      certificates["plans"].get<double>() / activations, certificates["repairs"].get<double>() / activations,
      certificates["events"].get<double>() / activations);
  EXPECT_NE(run_noli({"explain", run_path("run")}).out.find(said), std::string::npos) << said;
  EXPECT_EQ(certificates["penned"], first["timing"]["certificates"]["penned"].get<std::uint64_t>() +
                                        second["timing"]["certificates"]["penned"].get<std::uint64_t>());
  EXPECT_EQ(json["timing"]["windows_logged"], 200);
}

TEST_F(Simulate, ExplainDoesNotKnowWhatAPartOfTheLogDoesNotTell) {
  ASSERT_EQ(run_noli({"simulate", scene(two_cloths()), "-o", run_path("run")}).exit_code, 0);
  ASSERT_NE(run_noli({"explain", run_path("run")}).out.find("events of certificates"), std::string::npos);
  std::string lines;
  read_log_lines(run_path("run"), [&](Json entry) {
    if (entry["event"] == "end") {
      entry["timing"]["certificates"].erase("events");  // as in earlier versions
      entry["timing"]["certificates"]["penned"] = 7;
    }
    lines += log_line(entry);
  });
  folder.write("run/log.jsonl", lines);
  const Json certificates = json_of({"explain", run_path("run")}, 0)["timing"]["certificates"];
  EXPECT_TRUE(certificates["events"].is_null()) << certificates;
  EXPECT_GT(certificates["plans"], 0);
  EXPECT_EQ(certificates["penned"], 7);
  EXPECT_EQ(run_noli({"explain", run_path("run")}).out.find("events of certificates"), std::string::npos);
}

TEST_F(Simulate, ExplainSaysTheSameHoweverTheRunWasMade) {
  const std::string file = scene(two_cloths());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("whole")}).exit_code, 0);
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("parts"), "--until", "0.13", "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("parts"), "--resume"}).exit_code, 0);
  const Json whole = json_of({"explain", run_path("whole")}, 0), parts = json_of({"explain", run_path("parts")}, 0);
  EXPECT_GE(whole["deepest"]["layer"], 1);
  EXPECT_LT(whole["gap"]["above"], whole["gap"]["up_to"]);
  EXPECT_LE(whole["gap"]["up_to"], whole["nearest"]["distance"].get<double>() * (1 + 1e-12));
  EXPECT_GT(whole["gap"]["above"], whole["timing"]["bound"]);
  EXPECT_EQ(without_timing(whole), without_timing(parts));
}

TEST_F(Simulate, ExplainOfFramesSaysWhatIsNotKnown) {
  Json json = bouncing_point();
  json["record"] = "frames";
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run")}).exit_code, 0);
  const Json explained = json_of({"explain", run_path("run")}, 0);
  EXPECT_EQ(explained["record"], "frames");
  EXPECT_EQ(explained["gap"], nullptr);
  EXPECT_GT(explained["nearest"]["distance"], 0);
  EXPECT_NE(run_noli({"explain", run_path("run")}).out.find("World lines were not recorded"), std::string::npos);
}

TEST_F(Simulate, ExplainOfARunWithoutContact) {
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("run")}).exit_code, 0);
  const Json json = json_of({"explain", run_path("run")}, 0);
  EXPECT_EQ(json["deepest"], nullptr);
  EXPECT_EQ(json["gap"], nullptr);
  EXPECT_EQ(json["layer_cap"], nullptr);
  EXPECT_EQ(json["timing"]["bound"], nullptr);
  EXPECT_GT(json["events"]["membrane"], 0);
  EXPECT_GT(json["smallest_step"], 0);
  const Process text = run_noli({"explain", run_path("run")});
  EXPECT_NE(text.out.find("the scene has no contact forces"), std::string::npos) << text.out;
}

TEST_F(Simulate, ExplainDoesWithoutALog) {
  ASSERT_EQ(run_noli({"simulate", scene(bouncing_point()), "-o", run_path("run")}).exit_code, 0);
  const Json before = json_of({"explain", run_path("run")}, 0);
  add_entry(run_path("run"), {{"what", "is this"}});
  add_entry(run_path("run"), {{"event", 1}});
  add_entry(run_path("run"), {{"event", "begin"}, {"bodies", 3}});
  const Json damaged = json_of({"explain", run_path("run")}, 0);
  EXPECT_EQ(damaged["timing"]["bad_lines"], 2);
  EXPECT_EQ(damaged["timing"]["parts"], 2);
  EXPECT_EQ(damaged["timing"]["end"], "");  // unknown for the last part
  EXPECT_EQ(damaged["deepest"]["names"], "vertex 2 and edge 0-1");
  fs::remove(run_path("run/log.jsonl"));
  const Json json = json_of({"explain", run_path("run")}, 0);
  EXPECT_EQ(json["gap"], before["gap"]);
  EXPECT_EQ(json["timing"]["bound"], nullptr);
  EXPECT_EQ(json["deepest"]["names"], "vertex 2 and edge 0-1");
}

TEST_F(Simulate, ExplainTellsOfWindowsThatWereRolledBack) {
  ASSERT_EQ(run_noli({"simulate", scene(bouncing_point()), "-o", run_path("run")}).exit_code, 0);
  EXPECT_EQ(json_of({"explain", run_path("run")}, 0)["roll_backs"], Json::array());
  add_entry(run_path("run"), {{"event", "roll_back"}, {"window", 3}, {"try", 1}});
  const Json json = json_of({"explain", run_path("run")}, 0);
  EXPECT_EQ(json["roll_backs"].size(), 1);
  EXPECT_EQ(json["roll_backs"][0]["window"], 4);  // the log counts from 0
}

TEST_F(Simulate, ExplainTellsTheEnergyOfTheBeginning) {
  Json json = bouncing_point();
  json["bodies"][1]["mesh"]["points"]["at"] = {{0.1, 0.09}};  // within the first layer
  json["duration"] = 0.125;
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run")}).exit_code, 0);
  const Json energy = json_of({"explain", run_path("run")}, 0)["energy"];
  EXPECT_NEAR(energy["begin"].get<double>(), 9.81 * 0.09 + 0.5 * 100 * 0.01 * 0.01, 1e-12);
}

TEST_F(Simulate, ExplainNamesWhoMeetsWhereTheyMeetDifferently) {
  const std::string file = (fs::path(NOLI_SOURCE_DIR) / "scenes/incline.json").string();
  ASSERT_EQ(run_noli({"simulate", file, "--short", "--until", "0.1", "-o", run_path("run")}).exit_code, 0);
  const std::string text = run_noli({"explain", run_path("run")}).out;
  EXPECT_NE(text.find("material 1 (sticks and plane): "), std::string::npos) << text;
  EXPECT_NE(text.find("material 2 (slips and plane): "), std::string::npos) << text;
}

TEST_F(Simulate, ALogOfOneMaterialNamesNoPairs) {
  ASSERT_EQ(run_noli({"simulate", scene(bouncing_point()), "-o", run_path("run")}).exit_code, 0);
  const std::string begin = bytes_of(run_path("run/log.jsonl"));
  Json entry = Json::parse(begin.substr(0, begin.find('\n')));
  for (const char* member : {"pairs", "more_pairs"}) {
    EXPECT_FALSE(entry["contact"]["materials"][0].contains(member)) << "all meet in the same way";
  }
}

TEST_F(Simulate, ExplainWantsARun) {
  const std::string file = scene(bouncing_point());
  const Process none = run_noli({"explain", fs::path(file).parent_path().string()});
  EXPECT_EQ(none.exit_code, 3) << none.err;
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.1"}).exit_code, 0);
  const Process brief = run_noli({"explain", run_path("run"), "--short"});
  EXPECT_EQ(brief.exit_code, 3);
  EXPECT_NE(brief.err.find("--short"), std::string::npos) << brief.err;
  EXPECT_EQ(run_noli({"explain", run_path("run"), "--json", run_path("run/log.jsonl")}).exit_code, 3);
}

TEST_F(Simulate, ARunOfAnEarlierVersionIsRefused) {
  RunScene scene;
  scene.header.window_length = bouncing_point().value("window", 0.01);
  scene.mesh.vertex_count = 1;
  scene.mesh.points = {0};
  scene.labels = {0};
  const std::string file = this->scene(bouncing_point());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.1"}).exit_code, 0);
  fs::remove(run_path("run/trajectory.blocks"));
  {
    RunWriter writer(run_path("run"), scene);
    const std::vector<Position> rest(1, Position{});
    const WorldLines lines = WorldLines::from_frames(rest, rest);
    writer.append_window({0, lines, rest, std::string(8 * 30, '\0'), {}});
    writer.commit();
  }
  for (const auto& command : {std::vector<std::string>{"explain", run_path("run")},
                              {"export", run_path("run"), "--figure", "energy", "-o", run_path("energy.csv")}}) {
    const Process process = run_noli(command);
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("expected a run of this version"), std::string::npos) << process.err;
  }
}

}  // namespace
}  // namespace noli::app_tests
