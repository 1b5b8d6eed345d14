// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

TEST(FuzzQueries, FindsNoDifferenceAndDependsOnTheSeedAlone) {
  const Folder folder;
  const auto run = [&](const std::string& seed, const std::string& threads) {
    return without_timing(json_of(
        {"fuzz", "queries", "--count", "4000", "--seed", seed, "--threads", threads, "--out", folder.path("out")}, 0));
  };
  const std::string one = run("5", "1");
  EXPECT_EQ(one, run("5", "2"));
  EXPECT_NE(one, run("6", "2"));
  EXPECT_TRUE(folder.names().empty());
}

TEST(FuzzQueries, KeepsACorpusWhateverTheNumberOfThreads) {
  const Folder one, two;
  const auto run = [](const Folder& folder, const std::string& seed, const std::string& threads) {
    return json_of({"fuzz", "queries", "--count", "3000", "--seed", seed, "--threads", threads, "--out",
                    folder.path("out"), "--corpus", folder.path("corpus")},
                   0);
  };
  const auto first = run(one, "5", "1");
  EXPECT_GT(first["corpus"]["kept"], 30);
  EXPECT_EQ(first["queries"], 3000);
  EXPECT_EQ(without_timing(first), without_timing(run(two, "5", "3")));
  const auto again = run(one, "5", "2"), other = run(two, "6", "3");
  EXPECT_EQ(again["corpus"]["replayed"], first["corpus"]["kept"]);
  EXPECT_EQ(again["corpus"]["kept"], 0);
  EXPECT_EQ(again["queries"], 3000 + again["corpus"]["replayed"].get<int>());
  EXPECT_GT(other["corpus"]["kept"], 0) << "another seed reaches something else";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(two.path("corpus"))) {
    ++files;
    EXPECT_EQ(run_noli({"fuzz", "queries", "--replay", entry.path().string()}).exit_code, 0) << entry.path();
    if (files == 20) break;
  }
  EXPECT_EQ(files, 20u);
}

TEST(FuzzQueries, TakesWholeNumbersThatFitAndNoOthers) {
  for (const char* const count : {"0", "-5", "1e3", "010", "18446744073709551615", "18446744073709551616"}) {
    EXPECT_EQ(run_noli({"fuzz", "queries", "--count", count}).exit_code, 3) << count;
  }
  for (const char* const seed : {"-1", "010", "99999999999999999999999"}) {
    EXPECT_EQ(run_noli({"fuzz", "queries", "--count", "1", "--seed", seed}).exit_code, 3) << seed;
  }
  EXPECT_EQ(run_noli({"fuzz", "queries", "--count", "1", "--seed", "18446744073709551615"}).exit_code, 0);
}

TEST(FuzzQueries, StopsWhenItsTimeIsOver) {
  const Folder folder;
  const Process process = run_noli({"fuzz", "queries", "--for", "300ms", "--out", folder.path("out")});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(process.verdict_line().rfind("NO DIFFERENCE  queries ", 0), 0u) << process.out;
}

const char* const falling_point = "0,1,0,1,1,1\n0,1,0,1,0,1\n0,1,0,1,-1,1\n0,1,0,1,0,1\n";

TEST(FuzzQueries, ReplaysAFile) {
  const Folder folder;
  folder.write(
      "vertex-vertex.csv",
      std::string(falling_point) + "# noli-fuzz dimension 3 eta 0.5 normal 0 0 1 gap 0.5 from 0 points 0 1 rays 0 1\n");
  const Process process = run_noli({"fuzz", "queries", "--replay", folder.path("vertex-vertex.csv")});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(process.verdict_line(), "NO DIFFERENCE  queries 1, findings 0");
  EXPECT_EQ(run_noli({"ccd", folder.path("vertex-vertex.csv")}).exit_code, 0) << "the line is a comment";
}

TEST(FuzzQueries, RefusesWhatItCannotReplay) {
  const Folder folder;
  folder.write(
      "vertex-vertex.csv",
      std::string(falling_point) + "# noli-fuzz dimension 3 eta 0.5 normal 0 0 1 gap 0.5 from 0 points 0 3 rays 0 1\n");
  folder.write("some.csv", falling_point);
  for (const char* const name : {"vertex-vertex.csv", "some.csv", "absent-edge-edge.csv"}) {
    EXPECT_EQ(run_noli({"fuzz", "queries", "--replay", folder.path(name)}).exit_code, 3) << name;
  }
  EXPECT_EQ(run_noli({"fuzz", "queries", "--replay", folder.path("some.csv"), "--seed", "2"}).exit_code, 3);
}

}  // namespace
}  // namespace noli::app_tests
