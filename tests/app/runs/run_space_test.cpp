// SPDX-License-Identifier: Apache-2.0
//
// Tests the predicted size of a run, and what happens if the disk is too small for it.
#include "certify/simulate/run_space.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "integrator/scene/read_scene.h"
#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

TEST(RunSpace, BytesAreSaidInTwoDigits) {
  EXPECT_EQ(bytes_text(0), "0 bytes");
  EXPECT_EQ(bytes_text(999), "999 bytes");
  EXPECT_EQ(bytes_text(1500), "1.5 kB");
  EXPECT_EQ(bytes_text(9.96e6), "10 MB");
  EXPECT_EQ(bytes_text(2.4e9), "2.4 GB");
  EXPECT_EQ(bytes_text(80e9), "80 GB");
  EXPECT_EQ(bytes_text(999.6e9), "1.0 TB");
  EXPECT_EQ(bytes_text(3e25), "3e+07 EB");
}

TEST(RunSpace, WhatDoesNotFitIsAProblemAndWhatFitsIsNone) {
  RunBytes bytes;
  bytes.motion = 2e9;
  bytes.series = 4e8;
  bytes.proved = true;
  EXPECT_EQ(space_problem(bytes, "runs/a", 2'400'000'000), std::nullopt);
  EXPECT_EQ(space_problem(bytes, "runs/a", std::nullopt), std::nullopt);
  EXPECT_EQ(space_problem(bytes, "runs/a", 2'399'999'999),
            "-o runs/a: the disk has 2.4 GB left, but the run needs about 2.4 GB of world lines, proof and frames; "
            "free space, record only frames (\"record\": \"frames\" in the scene), shorten the run with --until, or "
            "pass --ignore-space, as this is a prediction");
  bytes.full = bytes.proved = false;
  EXPECT_EQ(space_problem(bytes, "runs/a", 5),
            "-o runs/a: the disk has 5 bytes left, but the run needs about 2.4 GB of frames; free space, shorten the "
            "run with --until, or pass --ignore-space, as this is a prediction");
}

TEST(RunSpace, TheNoteHasWhatComesAndWhatIsFree) {
  RunBytes bytes;
  bytes.motion = 2.4e9;
  EXPECT_EQ(space_note(bytes, "runs/a", 80'000'000'000), "about 2.4 GB of world lines in runs/a; 80 GB are free");
  EXPECT_EQ(space_note(bytes, "runs/a", std::nullopt), "about 2.4 GB of world lines in runs/a");
  bytes.at_least = true;
  EXPECT_EQ(space_note(bytes, "runs/a", std::nullopt), "at least about 2.4 GB of world lines in runs/a");
}

TEST(RunSpace, WhatIsThereCountsOff) {
  const integrator::Scene scene = integrator::parse_scene(resting_bar(1, 0.01).dump(), "bar.json");
  const integrator::Explanation explanation = integrator::explain(scene);
  RunToCome run;
  run.vertices = 2;
  run.cells = 1;
  run.windows = 100;
  run.time = 1;
  run.series = false;
  const double whole = bytes_to_come(scene, explanation, run).motion;
  EXPECT_GT(whole, explanation.bytes_in_all);
  // Once the run has begun, its own bytes per second count, however many windows a second has.
  run.bytes_there = 75'000;
  run.time_there = 0.75;
  for (const std::uint64_t windows : {75, 1000}) {
    run.windows_there = windows;
    EXPECT_EQ(bytes_to_come(scene, explanation, run).motion, 25'000);
  }
  run.series = true;
  const double rows = bytes_to_come(scene, explanation, run).series;
  run.windows_there = 75;
  EXPECT_GT(rows, bytes_to_come(scene, explanation, run).series) << "each window has a row";
  run.time_there = 1;
  EXPECT_EQ(bytes_to_come(scene, explanation, run).motion, 0);
  run.time_there = 1.01;
  EXPECT_EQ(bytes_to_come(scene, explanation, run).motion, 0);
}

TEST(RunSpace, TheSpaceOfAFolderThatIsNotThereIsThatOfTheOneAbove) {
  const Folder folder;
  EXPECT_TRUE(free_bytes(folder.path("not/there")).has_value());
  EXPECT_EQ(bytes_in(folder.path("not/there")), 0);
  folder.write("a", "12345");
  folder.write("b", "123");
  EXPECT_EQ(bytes_in(fs::path(folder.path("a")).parent_path()), 8);
}

std::uint64_t said(const std::string& err) {
  const std::size_t at = err.find("about ");
  EXPECT_NE(at, std::string::npos) << err;
  double number = 0;
  char unit[8] = {};
  EXPECT_EQ(std::sscanf(err.c_str() + at, "about %lf %7s", &number, unit), 2) << err;
  const std::map<std::string, double> units = {{"bytes", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}};
  return static_cast<std::uint64_t>(number * units.at(unit));
}

TEST_F(Simulate, TheBytesToComeAreSaidAndAreAboutThoseThatCome) {
  for (const char* record : {"full", "frames"}) {
    Json json = hanging_sheet();
    json["record"] = record;
    const std::string run = run_path(record);
    const Process process = run_noli({"simulate", scene(json), "-o", run});
    ASSERT_EQ(process.exit_code, 0) << process.err;
    EXPECT_NE(process.err.find(" in " + run + "; "), std::string::npos) << process.err;
    EXPECT_NE(process.err.find(" are free.\n"), std::string::npos) << process.err;
    const double predicted = static_cast<double>(said(process.err)), there = static_cast<double>(bytes_in(run));
    EXPECT_GT(predicted, there / 1.5) << process.err;
    EXPECT_LT(predicted, there * 1.5) << process.err;
  }
}

TEST_F(Simulate, ADiskThatWillNotHoldTheRunIsKnownBeforeItBegins) {
  Json json = hanging_sheet();
  json["duration"] = 1e9;
  json["gravity"] = {0, 0, 0};  // at rest, so that only the interruption ends it
  json["bodies"][0].erase("perturb");
  const std::string file = scene(json), run = run_path("run");
  const Process process = run_noli({"simulate", file, "-o", run});
  EXPECT_EQ(process.exit_code, 4) << process.err;
  EXPECT_NE(process.err.find("-o " + run + ": the disk has "), std::string::npos) << process.err;
  EXPECT_NE(process.err.find(" PB of world lines, proof and frames; free space, "), std::string::npos) << process.err;
  EXPECT_FALSE(fs::exists(run));
  EXPECT_EQ(run_noli({"simulate", file, "-o", run, "--until", "0.05"}).exit_code, 0);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run, "--resume"}).exit_code, 4);
  EXPECT_EQ(json_of({"verify", run}, 0)["run"]["end"], "done");  // the refused call left no trace
  const Process meant = run_noli({"simulate", file, "-o", run, "--resume", "--ignore-space"}, interrupt_after(200));
  EXPECT_EQ(meant.exit_code, 2) << meant.err;
}

}  // namespace
}  // namespace noli::app_tests
