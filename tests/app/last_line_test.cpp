// SPDX-License-Identifier: Apache-2.0
//
// Tests the end of the output: the verdict in the last line for people, one line of pairs for programs, nothing with
// -q.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

class LastLine : public Simulate {
 protected:
  /// A `verify` command for the upper triangle at these heights, in files a.ply, b.ply, ...
  std::vector<std::string> verify(const std::vector<double>& heights, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), "verify");
    char name = 'a';
    for (const double height : heights) {
      more.push_back(folder.write(std::string(1, name++) + ".ply", two_triangles(height)));
    }
    return more;
  }
  static std::string last(const std::vector<std::string>& arguments) { return run_noli(arguments).verdict_line(); }
};

bool starts(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

TEST_F(LastLine, NamesStepFilesTimeAndFeatures) {
  EXPECT_EQ(last(verify({1, 0.5, -0.5})), "CONTACT  step 2 (b.ply → c.ply)  t = 0.5  vertex 3 × face 0 at (1, 1, 0)");
}

TEST_F(LastLine, NeverRoundsATimeToTheEndOfItsStep) {
  const auto expect = [](const std::string& line, const std::string& time) {
    EXPECT_TRUE(starts(line, "CONTACT  step 1 (a.ply → b.ply)  t = " + time + "  vertex 3 × face 0 at (1, 1, "))
        << line;
  };
  expect(last(verify({1, -1e-9})), "0.9999");  // the contact is just before the end
  expect(last(verify({0.375, -0.25})), "0.6");
  expect(last(verify({1, 0})), "1");
}

TEST_F(LastLine, SaysWhoAcceptedAProof) {
  const std::string proved = last(verify({1, 0.5}));
  EXPECT_TRUE(starts(proved, "PROVED  2 frames, 1 step: nothing touches (accepted by noli_check ")) << proved;
  EXPECT_EQ(last(verify({1, 0.5}, {"--no-check"})),
            "NO CONTACT  2 frames, 1 step: nothing touches (decided exactly, not checked)");
}

TEST_F(LastLine, SaysWhatWeakensTheClaim) {
  const std::string rest = last(verify({1}, {"--static"}));
  EXPECT_TRUE(starts(rest, "PROVED  1 frame at rest: nothing touches")) << rest;
  const std::string apart = last(verify({1, 0.5}, {"--min-distance", "0.25"}));
  EXPECT_NE(apart.find("nothing touches, and all is more than 0.25 apart"), std::string::npos) << apart;
}

TEST_F(LastLine, NamesTheCellsThatComeTooNear) {
  const std::string near = last(verify({1, 0.5}, {"--min-distance", "0.75"}));
  EXPECT_TRUE(starts(near, "TOO NEAR  step 1 (a.ply → b.ply)  for example at t = ")) << near;
  EXPECT_NE(near.find(", not more than 0.75 apart"), std::string::npos) << near;
}

TEST_F(LastLine, OfARunNamesItsWindow) {
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("run")}).exit_code, 0);
  const std::string proved = last({"verify", run_path("run")});
  EXPECT_TRUE(starts(proved, "PROVED  25 windows, ")) << proved;
}

TEST_F(LastLine, OfASimulationSaysHowFarItWent) {
  const Process process = run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("run"), "--until", "0.1"});
  EXPECT_TRUE(starts(process.verdict_line(), "NO CONTACT  10 of 10 windows, 0.1 s: nothing ")) << process.out;
}

TEST_F(LastLine, StatementAndWorkAreForWhoAsks) {
  const std::string brief = run_noli(verify({1, 0.5})).out, all = run_noli(verify({1, 0.5}, {"-v"})).out;
  for (const char* part : {"Statement:", "Stages:", "Time: "}) {
    EXPECT_EQ(brief.find(part), std::string::npos) << brief;
    EXPECT_NE(all.find(part), std::string::npos) << all;
  }
}

TEST_F(LastLine, TellsWhatToDoAboveAContact) {
  const std::string out = run_noli(verify({1, 0.5, -0.5, 1})).out;
  EXPECT_NE(out.find("\nNext: --json result.json keeps the result, "), std::string::npos) << out;
  EXPECT_NE(out.find("; --keep-going counts the contacts of all steps.\n"), std::string::npos) << out;
  const std::string all = run_noli(verify({1, 0.5, -0.5, 1}, {"--keep-going"})).out;
  EXPECT_EQ(all.find("--keep-going"), std::string::npos) << all;
  EXPECT_NE(run_noli(verify({1, 0.5})).out.find("\nNext: --proof OUT.noli keeps the proof"), std::string::npos);
}

TEST_F(LastLine, PorcelainIsOneLineOfPairs) {
  const Process process = run_noli(verify({1, 0.5, -0.5}, {"--porcelain"}));
  EXPECT_EQ(process.exit_code, 1);
  EXPECT_EQ(std::count(process.out.begin(), process.out.end(), '\n'), 1);
  EXPECT_TRUE(starts(process.out, "verdict=contact contacts.vertex_face=3 contacts.edge_edge=0 ")) << process.out;
  EXPECT_NE(process.out.find(" first_time=0.5 steps=2 steps_total=2 "), std::string::npos) << process.out;
  std::istringstream words(process.out);
  for (std::string word; words >> word;) EXPECT_NE(word.find('='), std::string::npos) << word;
}

TEST_F(LastLine, QuietPrintsNothing) {
  for (const auto& [heights, code] : {std::pair(std::vector<double>{1, 0.5}, 0), {{1, -1}, 1}}) {
    const Process process = run_noli(verify(heights, {"-q"}));
    EXPECT_EQ(process.out, "");
    EXPECT_EQ(process.exit_code, code);
  }
  EXPECT_EQ(run_noli(verify({1, 0.5}, {"-q", "--porcelain"})).exit_code, 3);
  EXPECT_EQ(run_noli(verify({1, 0.5}, {"-q", "-v"})).exit_code, 3);
  EXPECT_EQ(run_noli(verify({1, 0.5}, {"-v", "--porcelain"})).exit_code, 3);
}

TEST_F(LastLine, JsonSaysWhoWroteItAndInWhatForm) {
  const nlohmann::json json = json_of(verify({1, 0.5}), 0);
  EXPECT_EQ(json["schema"], "noli-verify");
  EXPECT_EQ(json["version"], 1);
  EXPECT_FALSE(json["noli"]["version"].get<std::string>().empty());
  EXPECT_FALSE(json["noli"]["commit"].get<std::string>().empty());
}

}  // namespace
}  // namespace noli::app_tests
