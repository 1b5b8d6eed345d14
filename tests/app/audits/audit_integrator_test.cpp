// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli audit integrator`.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

class AuditIntegrator : public testing::Test {
 protected:
  /// A chain in the plane with a stiff middle.
  std::string chain(const Json& more = Json::object()) const {
    Json scene = Json::parse(R"({
      "noli_scene": 1, "title": "stiff in the middle", "dimension": 2, "duration": 0.3, "window": 0.1, "bodies": [
        {"name": "chain", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 6}},
         "deform": {"stretch": [1.1, 1]}, "velocity": [0.3, 0.2], "spin": 1,
         "material": {"edge_stiffness": 100, "mass_per_length": 1},
         "patches": [{"box": [[-0.2, -1], [0.2, 1]], "stiffness_factor": 100}]}]})");
    scene.update(more);
    return folder.write("scene.json", scene.dump(2));
  }

  Folder folder;
};

TEST_F(AuditIntegrator, MeasuresASceneAndDrawsIt) {
  const std::string picture = folder.path("picture.svg");
  const Process process = run_noli({"audit", "integrator", chain(), "--svg", picture, "--halvings", "2"});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(process.verdict_line(), "MEASURED  scenes 1, runs 12");
  EXPECT_NE(process.out.find("stiff in the middle: 7 vertices, 6 forces"), std::string::npos) << process.out;
  const std::string svg = read_text(picture);
  for (const char* const words :
       {"<svg ", "stiff in the middle", "Verlet, one step for all", "run time [s]", "error of the trajectory",
        "error of energy", "error of momentum", "error of angular momentum"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  }
  std::size_t lines = 0;
  for (std::size_t at = svg.find("<polyline "); at != std::string::npos; at = svg.find("<polyline ", at + 1)) ++lines;
  EXPECT_EQ(lines, 16u) << "four methods, four errors";
}

TEST_F(AuditIntegrator, IsTheSameButForTiming) {
  const std::vector<std::string> command = {"audit", "integrator", chain(), "--halvings", "1"};
  const Json json = json_of(command, 0);
  EXPECT_EQ(without_timing(json), without_timing(json_of(command, 0)));
  const Json& scene = json["scenes"][0];
  EXPECT_EQ(scene["windows"], 3);
  EXPECT_EQ(scene["plain_loop"], true);
  EXPECT_EQ(scene["methods"][1]["method"], "grouped");
  EXPECT_GT(scene["methods"][1]["points"][0]["errors"]["trajectory"], 0);
  EXPECT_EQ(json["timing"]["scenes"][0]["methods"][1]["seconds"].size(), 2u);
}

TEST_F(AuditIntegrator, ContactIsMeasuredToo) {
  const std::string scene = std::string(NOLI_SOURCE_DIR) + "/scenes/restitution.json";
  const Json json = json_of({"audit", "integrator", scene, "--windows", "12", "--halvings", "1"}, 0);
  EXPECT_EQ(json["scenes"][0]["plain_loop"], false);
  EXPECT_EQ(json["scenes"][0]["methods"].size(), 3u);
}

TEST_F(AuditIntegrator, NumbersThatRunOutAreAFinding) {
  const std::string scene = chain({{"allow_unstable", true}, {"step_factor", 40}, {"duration", 100}});
  const Json json = json_of({"audit", "integrator", scene, "--windows", "1000", "--halvings", "0"}, 1);
  EXPECT_EQ(json["verdict"], "finding");
}

TEST_F(AuditIntegrator, ACtrlCEndsIt) {
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(300);
  const Process process = run_noli({"audit", "integrator", "--halvings", "6"}, options);
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_TRUE(process.verdict_line().starts_with("UNDECIDED ")) << process.out;
}

TEST_F(AuditIntegrator, BadInputIsRefused) {
  EXPECT_EQ(run_noli({"audit", "integrator", folder.path("none.json")}).exit_code, 3);
  EXPECT_EQ(run_noli({"audit", "integrator", chain(), "--halvings", "-1"}).exit_code, 3);
  EXPECT_EQ(run_noli({"audit", "integrator", chain(), "--svg", folder.path("no/folder.svg")}).exit_code, 3);
  const std::string scene = chain();
  EXPECT_EQ(run_noli({"audit", "integrator", scene, "--svg", scene}).exit_code, 3);
}

TEST_F(AuditIntegrator, TheWorkedExampleIsTrue) {
  const auto commands = worked_example("docs/audit/integrator.md");
  ASSERT_GE(commands.size(), 2u);
  expect_worked_example(
      commands, {{"build/release/app/noli", NOLI_COMMAND}, {"build/integrator.svg", folder.path("integrator.svg")}});
}

}  // namespace
}  // namespace noli::app_tests
