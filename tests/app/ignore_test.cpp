// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli verify --ignore`: groups of vertices whose cells are not compared.
#include <gtest/gtest.h>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

class Ignore : public testing::Test {
 protected:
  /// A triangle falls through another one and, a moment later, through a third.
  std::vector<std::string> frames() const {
    std::vector<std::string> paths;
    for (const double height : {1.0, -2.0}) {
      const std::vector<Position> points = {{0, 0, 0},  {4, 0, 0},      {0, 4, 0},        {0, 0, -1},      {4, 0, -1},
                                            {0, 4, -1}, {1, 1, height}, {1.5, 1, height}, {1, 1.5, height}};
      paths.push_back(
          folder.write(std::to_string(paths.size()) + ".ply", ply_text(points, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}})));
    }
    return paths;
  }
  Process verify(const std::string& groups, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"verify", "--ignore", folder.write("groups.json", groups)};
    for (const auto& frame : frames()) arguments.push_back(frame);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_noli(arguments);
  }
  static constexpr const char* all =
      R"({"groups": {"upper": [[0, 2]], "lower": [3, 4, 5], "falling": [[6, 8]]}, "ignore": )";

  Folder folder;
};

TEST_F(Ignore, LeavesOutPairsOfGroups) {
  EXPECT_EQ(verify(std::string(all) + R"([["falling", "upper"], ["lower", "falling"]]})").verdict_line().substr(0, 8),
            "PROVED  ");
  const Process second = verify(std::string(all) + R"([["falling", "upper"]]})", {"-v"});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_NE(second.out.find(" × face 1 at ("), std::string::npos) << second.out;
  EXPECT_NE(second.out.find("two cells of upper and falling, which --ignore leaves out"), std::string::npos);
  EXPECT_NE(verify(std::string(all) + R"([["upper", "upper"]]})").out.find(" × face 0 at ("), std::string::npos);
}

TEST_F(Ignore, AGroupMayPassThroughItself) {
  EXPECT_EQ(verify(R"({"groups": {"everything": [[0, 8]]}, "ignore": [["everything", "everything"]]})").exit_code, 0);
}

TEST_F(Ignore, IsPartOfTheClaim) {
  const std::string proof = folder.path("proof.noli");
  ASSERT_EQ(verify(std::string(all) + R"([["falling", "upper"], ["lower", "falling"]]})",
                   {"--force", "--proof", proof, "--claim-out", folder.path("claim.json")})
                .exit_code,
            0);
  std::vector<std::string> arguments = {"check", proof};
  for (const auto& frame : frames()) arguments.push_back(frame);
  EXPECT_EQ(run_noli(arguments).exit_code, 3);  // exclusions were not requested
  arguments.insert(arguments.end(), {"--claim", folder.path("claim.json")});
  const Process plain = run_noli(arguments);
  EXPECT_EQ(plain.exit_code, 0) << plain.out;
  EXPECT_NE(plain.out.find("ACCEPTED  nothing that is compared touches; not compared: 1-3,2-3 ("), std::string::npos);
  EXPECT_NE(plain.out.find("Not compared, pairs of labels: 1-3 2-3"), std::string::npos) << plain.out;
  EXPECT_NE(plain.out.find("Cells with a label: 1 with 1; 1 with 2; 1 with 3; no others."), std::string::npos)
      << plain.out;
  if (!verified_checker_is_there()) return;
  arguments.emplace_back("--verified");
  EXPECT_EQ(run_noli(arguments).verdict_of_checker(), plain.verdict_of_checker());
}

TEST_F(Ignore, WitnessesAreOfPairsThatCount) {
  const std::string proof = folder.path("proof.noli");
  ASSERT_EQ(verify(std::string(all) + R"([["falling", "upper"]]})", {"--force", "--proof", proof}).exit_code, 1);
  std::vector<std::string> arguments = {"check", proof};
  for (const auto& frame : frames()) arguments.push_back(frame);
  const Process plain = run_noli(arguments);
  EXPECT_EQ(plain.exit_code, 1) << plain.out;
}

TEST_F(Ignore, RefusesWhatItCannotMean) {
  const std::vector<std::array<std::string, 2>> bad = {
      {"", ""},
      {"[]", "an object"},
      {R"({"groups": {"a": [0]}})", "/ignore"},
      {R"({"groups": {"a": [[0, 2]]}, "ignore": []})", "/ignore"},
      {R"({"groups": {"a": [[0, 2]]}, "ignore": [["a"]]})", "/ignore/0"},
      {R"({"groups": {"a": [[0, 2]]}, "ignore": [["a", "b"]]})", "no group b"},
      {R"({"groups": {"a": [[0, 2]]}, "ignore": [["a", ""]]})", "no group"},
      {R"({"groups": {"a": [[2, 0]]}, "ignore": [["a", "a"]]})", "/groups/a/0"},
      {R"({"groups": {"a": [9]}, "ignore": [["a", "a"]]})", "no vertex 9"},
      {R"({"groups": {"a": [-1]}, "ignore": [["a", "a"]]})", "/groups/a/0"},
      {R"({"groups": {"a": [0.5]}, "ignore": [["a", "a"]]})", "/groups/a/0"},
      {R"({"groups": {"a": [[0, 2]], "b": [2]}, "ignore": [["a", "b"]]})", "in group a already"},
      {R"({"groups": {"a": [0]}, "ignore": [["a", "a"]]})", "two groups"},
      {R"({"groups": {"": [0]}, "ignore": [["", ""]]})", "with a name"},
      {R"({"groups": {"a": []}, "ignore": [["a", "a"]]})", "/groups/a"},
      {R"({"groups": {"a": [0]}, "more": 1, "ignore": [["a", "a"]]})", "/more"},
  };
  for (const auto& [text, part] : bad) {
    const Process process = verify(text);
    EXPECT_EQ(process.exit_code, 3) << text;
    EXPECT_NE(process.err.find("groups.json"), std::string::npos) << process.err;
    EXPECT_NE(process.err.find(part), std::string::npos) << process.err;
  }
  EXPECT_EQ(run_noli({"verify", "--ignore", "/nowhere/groups.json", frames()[0], frames()[1]}).exit_code, 3);
}

}  // namespace
}  // namespace noli::app_tests
