// SPDX-License-Identifier: Apache-2.0
//
// Tests runs that stop early, within a window or while the series is written, and scenes that cannot run at all.
#include <gtest/gtest.h>

#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

/// Reading the series.h5 of this run takes longer than a stop waits.
TEST_F(Simulate, AStoppedRunWithALargeSeriesSaysItsVerdict) {
  Json json = beam(10000);
  json["frame_rate"] = 20000;
  const std::string run = run_path("run");
  const Process stopped = run_noli({"simulate", scene(json), "-o", run, "--time-limit", "1s", "--ignore-space"});
  EXPECT_EQ(stopped.exit_code, 2) << stopped.err;
  EXPECT_TRUE(stopped.verdict_line().starts_with("UNDECIDED ")) << stopped.out << stopped.err;
  EXPECT_EQ(last_entry(run)["event"], "end");
  const fs::path series = fs::path(run) / "series.h5";
#ifdef NOLI_SERIES
  ASSERT_TRUE(fs::exists(series));
  EXPECT_GT(fs::file_size(series), 2'000'000U);
#else
  EXPECT_FALSE(fs::exists(series)) << "built without noli_series";
#endif
}

class SimulateStop : public Simulate {};

TEST_F(SimulateStop, EndsWithinAWindow) {
  for (const char* steps : {"grouped", "own"}) {
    Json json = resting_bar(1e9, 1e8);  // a window would take hours
    json["steps"] = steps;
    const std::string file = scene(json);
    const auto expect = [&](const Process& process, const std::string& run, const std::string& end) {
      EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
      EXPECT_EQ(process.verdict_line().rfind("UNDECIDED  0 of ", 0), 0) << process.out;
      EXPECT_EQ(last_entry(run)["end"], end);
    };
    const std::string one = run_path(steps + std::string("1")), other = run_path(steps + std::string("2"));
    expect(run_noli({"simulate", file, "-o", one, "--ignore-space"}, interrupt_after(300)), one, "interrupted");
    expect(run_noli({"simulate", file, "-o", other, "--time-limit", "300ms", "--ignore-space"}), other, "time_limit");
    EXPECT_EQ(json_of({"verify", one}, 2)["steps"], 0);
  }
}

TEST_F(SimulateStop, TimeLimitsWithinWindowsChangeNoByte) {
  Json json = hanging_sheet();
  json["window"] = 0.05;
  const std::string file = scene(json);
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("whole")}).exit_code, 0);
  int exit_code = 2, calls = 0;
  while (exit_code == 2 && calls < 1000) {
    const std::string limit = std::to_string(1 + calls++) + "ms";
    std::vector<std::string> arguments = {"simulate", file, "-o", run_path("parts"), "--time-limit", limit};
    if (fs::exists(run_path("parts"))) arguments.emplace_back("--resume");
    exit_code = run_noli(arguments).exit_code;
  }
  EXPECT_EQ(exit_code, 0);
  EXPECT_GT(calls, 2);
  EXPECT_TRUE(blocks("parts") == blocks("whole"));
}

/// A sheet that falls onto a pinned one with soft layers, which go deep and need memory.
Json soft_landing() {
  const auto sheet = [](double size) -> Json { return {{"grid", {{"size", {size, size}}, {"cells", {40, 40}}}}}; };
  return {{"noli_scene", 1},
          {"duration", 1},
          {"window", 0.001},
          {"bodies",
           {{{"name", "falling"},
             {"mesh", sheet(1)},
             {"transform", {{"translate", {0.003, 0.004, 0.0301}}}},
             {"velocity", {0, 0, -1}},
             {"material", {{"edge_stiffness", 1}, {"mass_per_area", 1}}}},
            {{"name", "floor"},
             {"mesh", sheet(1.2)},
             {"material", {{"edge_stiffness", 0}, {"mass_per_area", 1}}},
             {"pin", {"all"}}}}},
          {"contact", {{"thickness", 0.008}, {"stiffness", 0.001}, {"step", 1e-5}}}};
}

TEST_F(SimulateStop, TooLittleMemoryKeepsWhatIsCommitted) {
  if (sanitized) GTEST_SKIP() << "sanitizers reserve address space of their own";
  const std::string file = scene(soft_landing());
  std::uint64_t most = 0;
  for (const std::uint64_t bytes : {230'000'000, 260'000'000, 400'000'000}) {
    SCOPED_TRACE(bytes);
    const std::string run = run_path(std::to_string(bytes));
    ProcessOptions limit;
    limit.address_space = bytes;
    const Process process = run_noli({"simulate", file, "-o", run, "--threads", "2"}, limit);
    EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
    EXPECT_NE(process.out.find("Out of memory in window "), std::string::npos) << process.out;
    EXPECT_NE(process.verdict_line().find("(out of memory)"), std::string::npos) << process.out;
    const Json end = last_entry(run);
    EXPECT_EQ(end["end"], "out_of_memory");
    const std::uint64_t windows = end["windows"];
    most = std::max(most, windows);
    const Json verified = json_of({"verify", run}, windows > 0 ? 0 : 2);
    EXPECT_EQ(verified["steps"], windows);
    EXPECT_EQ(verified["steps_total"], windows);
  }
  ASSERT_GT(most, 1U);
  ASSERT_LT(most, 1000U);
  // The run that ran out of memory resumes with enough memory, to the same bytes.
  const std::string until = std::to_string(0.001 * static_cast<double>(most + 1));
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("whole"), "--until", until}).exit_code, 0);
  const std::string first = "230000000";
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path(first), "--until", until, "--resume"}).exit_code, 0);
  EXPECT_TRUE(blocks(first) == blocks("whole"));
}

TEST_F(SimulateStop, WritingTheSeriesCanBeInterrupted) {
  Json json = resting_bar(1, 1);
  json["frame_rate"] = 1e9;  // hours
  const Process process =
      run_noli({"simulate", scene(json), "-o", run_path("run"), "--ignore-space"}, interrupt_after(700));
  EXPECT_EQ(process.exit_code, 0) << process.err;  // all windows are there
  if (!sanitized) {
    EXPECT_LT(process.peak_bytes, 200'000'000u);
  }
  EXPECT_EQ(process.verdict_line().rfind("NO CONTACT  1 of 1 windows", 0), 0) << process.out;
  EXPECT_NE(process.out.find("`--resume` writes it"), std::string::npos) << process.out;
  EXPECT_FALSE(fs::exists(run_path("run/series.h5")));
  EXPECT_EQ(last_entry(run_path("run"))["series"], "stopped");
  const std::string before = blocks("run");
  json["frame_rate"] = 60;
  EXPECT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run"), "--resume"}).exit_code, 0);
  EXPECT_NE(last_entry(run_path("run"))["series"], "stopped");
  EXPECT_TRUE(blocks("run") == before);
}

TEST_F(SimulateStop, StepsInAllAreThoseOfTheRun) {
  const std::string file = scene(resting_bar(1, 0x1p-9));
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run")}).exit_code, 0);
  const Json whole = json_of({"verify", run_path("run")}, 0);
  EXPECT_EQ(whole["steps"], 512);
  EXPECT_EQ(whole["steps_total"], 512);
  const Json part = json_of({"verify", run_path("run"), "--time-limit", "1ms"}, 2);
  EXPECT_LT(part["steps"], 512);
  EXPECT_EQ(part["steps_total"], 512);
}

TEST_F(SimulateStop, FramesThatCannotBeAreRefused) {
  Json json = resting_bar(1e9, 1e8);
  json["frame_rate"] = 1e9;
  const auto refused = [&](const std::string& problem) {
    const Process process = run_noli({"simulate", scene(json), "-o", run_path("run")});
    EXPECT_EQ(process.exit_code, 3) << process.err;
    EXPECT_NE(process.err.find("/frame_rate: " + problem), std::string::npos) << process.err;
    EXPECT_FALSE(fs::exists(run_path("run")));
  };
  refused("expected fewer than 2^53 frames in 1000000000 s");
  json["duration"] = json["window"] = 1;
  json["record"] = "frames";
  refused("the frames of a window take about 4.8e+10 bytes; expected at most 4.3e+09, as with frame_rate 8.9e+07");
  json["frame_rate"] = 1e4;
  EXPECT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run")}).exit_code, 0);
}

}  // namespace
}  // namespace noli::app_tests
