// SPDX-License-Identifier: Apache-2.0
//
// Tests every command that reads a run on runs with random changes and correct checksums. Each ends by itself, with an
// exit code, and never blames the machine or noli.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/app/runs/simulate_fixture.h"
#include "tests/trajectory/mutate_run.h"
#include "trajectory/write_file.h"

namespace noli::app_tests {
namespace {

class RunMutations : public Simulate {
 protected:
  /// Returns the number of commands that refused their run.
  int expect_ends(const Json& json, int count, std::uint64_t seed) {
    const std::string file = scene(json), whole = run_path("whole"), run = run_path("run");
    fs::remove_all(whole);
    EXPECT_EQ(run_noli({"simulate", file, "-o", whole}).exit_code, 0);
    const std::string bytes = blocks("whole");
    std::mt19937_64 random(seed);
    int refused = 0;
    for (int i = 0; i < count; ++i) {
      const std::string changes = random_changes(random);
      const std::string mutant = testing::mutated_run(bytes, changes);
      for (const auto& command : commands(file, run)) {
        fs::remove_all(run);
        fs::copy(whole, run, fs::copy_options::recursive);
        write_file(trajectory_path(run), mutant);
        refused += expect_end(command, in_hexadecimal(changes)) == 3 ? 1 : 0;
      }
    }
    return refused;
  }

 private:
  /// One to three changes, mostly of windows.
  static std::string random_changes(std::mt19937_64& random) {
    std::string changes;
    for (std::uint64_t n = 1 + random() % 3; n > 0; --n) {
      for (int k = 0; k < 6; ++k) changes += static_cast<char>(random());
    }
    return changes;
  }

  static std::string in_hexadecimal(const std::string& bytes) {
    std::string text;
    for (const char c : bytes) {
      for (const int shift : {4, 0}) text += "0123456789abcdef"[static_cast<unsigned char>(c) >> shift & 15];
    }
    return text;
  }

  std::vector<std::vector<std::string>> commands(const std::string& file, const std::string& run) const {
    return {{"verify", run, "--time-limit", "5s"},
            {"explain", run},
            {"report", run, "-o", run_path("page.html"), "--force"},
            {"export", run, "-o", run_path("frames/%d.ply"), "--force", "--fps", "20"},
            {"export", run, "--figure", "step-histogram", "-o", run_path("steps.svg"), "--force"},
            {"info", run},
            {"simulate", file, "--reproduce", run, "--window", "5", "-o", run_path("block")},
            {"simulate", file, "-o", run, "--resume", "--time-limit", "5s"}};
  }

  static int expect_end(const std::vector<std::string>& command, const std::string& changes) {
    ProcessOptions options;
    options.address_space = 4'000'000'000;
    const Process process = run_noli(command, options);
    EXPECT_TRUE(0 <= process.exit_code && process.exit_code <= 3)
        << command[0] << " ends with " << process.exit_code << " after the changes " << changes << "\n"
        << process.err;
    return process.exit_code;
  }
};

Json short_bounce() {
  Json json = bouncing_point();
  json["duration"] = 0.5;
  return json;
}

Json frames_of_cloths() {
  Json json = two_cloths();
  json["duration"] = 0.06;
  json["record"] = "frames";
  return json;
}

/// Found by fuzzing: a point moved onto the floor once caused an internal error.
TEST_F(RunMutations, WhatContactDoesNotAllowIsNotReproduced) {
  const std::string file = scene(short_bounce()), run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", file, "-o", run}).exit_code, 0);
  write_file(trajectory_path(run), testing::mutated_run(blocks("run"), "\xd6\x5f\x67\x7f\xdc\xdb"));
  const Process process = run_noli({"simulate", file, "--reproduce", run, "--window", "6", "-o", run_path("block")});
  EXPECT_EQ(process.exit_code, 3) << process.err;
  EXPECT_NE(process.err.find("window 6: integrated again, a pair needs more layers than allowed"), std::string::npos)
      << process.err;
}

TEST_F(RunMutations, EndByThemselves) { EXPECT_GT(expect_ends(short_bounce(), 60, 1), 100); }

TEST_F(RunMutations, OfFramesEndByThemselves) { EXPECT_GT(expect_ends(frames_of_cloths(), 30, 2), 50); }

TEST_F(RunMutations, SlowManyEndByThemselves) {
  const auto bounces = static_cast<int>(trials(150, 1000)), cloths = static_cast<int>(trials(75, 500));
  EXPECT_GT(expect_ends(short_bounce(), bounces, 3), 2 * bounces);
  EXPECT_GT(expect_ends(frames_of_cloths(), cloths, 4), 2 * cloths);
}

}  // namespace
}  // namespace noli::app_tests
