// SPDX-License-Identifier: Apache-2.0
//
// Tests runs in which something touches or comes too near: `noli verify` writes a witness that both checkers accept.
#include <fmt/format.h>

#include <cmath>

#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/runs/wild_run.h"

namespace noli::app_tests {
namespace {

class RunWitness : public Simulate {
 protected:
  std::string proof() const { return folder.path("proof.noli"); }
  Process verify(const std::string& run, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"verify", run, "--force", "--proof", proof()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_noli(arguments);
  }
  /// The exit code on which all checkers that are built agree.
  int check(const std::string& run, const std::string& distance = "0") const {
    const std::vector<std::string> asked = {"check", proof(), run, "--require", "distance=" + distance};
    const Process plain = run_noli(asked);
    if (verified_checker_is_there()) {
      std::vector<std::string> again = asked;
      again.emplace_back("--verified");
      EXPECT_EQ(run_noli(again).verdict_of_checker(), plain.verdict_of_checker());
    }
    return plain.exit_code;
  }
};

TEST_F(RunWitness, WildRunsAreProvedOrRefuted) {
  int proved = 0, refuted = 0, without = 0;
  for (unsigned seed = 0; seed < 80; ++seed) {
    const std::string run = run_path(std::to_string(seed));
    WildRun(seed, seed % 4 == 3 ? 2 : 3).write(run, 2);
    const Process process = verify(run, {});
    ASSERT_LE(process.exit_code, 1) << seed << process.err;
    const bool has_witness = process.out.find("No witness was found") == std::string::npos;
    without += has_witness ? 0 : 1;
    if (!has_witness) continue;
    EXPECT_EQ(check(run), process.exit_code) << seed;
    (process.exit_code == 0 ? proved : refuted) += 1;
  }
  std::printf("proved %d, refuted %d, without a witness %d\n", proved, refuted, without);
  EXPECT_GE(proved, 10);
  EXPECT_GE(refuted, 30);
  EXPECT_EQ(without, 0);
}

TEST_F(RunWitness, WhatComesTooNearHasOneToo) {
  int proved = 0, near = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const std::string run = run_path(std::to_string(seed));
    WildRun(seed, seed % 4 == 3 ? 2 : 3).write(run, 1);
    const Process process = verify(run, {"--min-distance", "0.25"});
    ASSERT_LE(process.exit_code, 1) << seed << process.out << process.err;
    if (process.verdict_line().starts_with("CONTACT")) continue;
    EXPECT_EQ(check(run, "0.25"), process.exit_code) << seed;
    (process.exit_code == 0 ? proved : near) += 1;
  }
  std::printf("proved %d, too near %d\n", proved, near);
  EXPECT_GE(proved, 5);
  EXPECT_GE(near, 5);
}

TEST_F(RunWitness, TheMeshMayAllowLess) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.02"}).exit_code, 0);
  const Process process = verify(run_path("run"), {"--min-distance", "0.5", "--json", folder.path("result.json")});
  EXPECT_EQ(process.exit_code, 1);
  const Json first = Json::parse(read_text(folder.path("result.json")))["first_frame"];
  const double allowed = first["allowed"], limit = first["not"];
  EXPECT_NE(process.out.find("The first frame allows "), std::string::npos);
  EXPECT_EQ(check(run_path("run"), "0.5"), 1);
  // The cells are squares of 1/6, each split in two and slightly perturbed.
  EXPECT_GT(allowed, 0.11);
  EXPECT_LT(limit, 0.13);
  EXPECT_LT(limit, allowed * (1 + 0x1p-19));
  const auto at = [&](double distance) {
    return verify(run_path("run"), {"--min-distance", fmt::format("{:.17g}", distance)}).verdict_line();
  };
  EXPECT_TRUE(at(limit).starts_with("TOO NEAR ")) << limit;
  EXPECT_TRUE(at(allowed * 0.99).starts_with("PROVED "));  // it moves a little
}

}  // namespace
}  // namespace noli::app_tests
