// SPDX-License-Identifier: Apache-2.0
//
// Runs scenes through the public interface: errors, progress, stops.
#include <noli/simulate.h>
#include <noli/verify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "tests/support/temporary_folder.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// A bar in the plane at rest; takes four windows.
constexpr const char* resting_bar = R"({
  "noli_scene": 1, "dimension": 2, "duration": 0.04, "window": 0.01, "gravity": [0, 0],
  "bodies": [{"name": "bar", "mesh": {"chain": {"points": [[0, 0], [1, 0]], "segments": 1}}, "steps": {"stretch": 1e-3},
              "material": {"edge_stiffness": 1, "mass_per_vertex": 1}}]})";

class SimulateInProcess : public testing::Test {
 protected:
  SimulateRequest request() const {
    SimulateRequest request;
    request.scene = folder.write("scene.json", resting_bar);
    request.run = folder / "run";
    request.threads = 1;
    return request;
  }

  test::TemporaryFolder folder;
};

TEST_F(SimulateInProcess, RunsToTheEnd) {
  const SimulateOutcome outcome = run_simulate(request());
  EXPECT_EQ(outcome.end, RunEnd::done);
  EXPECT_EQ(outcome.windows, 4U);
  EXPECT_TRUE(outcome.proved);
}

TEST_F(SimulateInProcess, StopsAtACondition) {
  std::vector<double> times;
  SimulateRequest asked = request();
  asked.keep_going = [&](const SeriesRow& row) {
    times.push_back(row.time);
    return times.size() < 2;
  };
  const SimulateOutcome outcome = run_simulate(asked);
  EXPECT_EQ(outcome.end, RunEnd::interrupted);
  EXPECT_EQ(outcome.windows, 2U);
  EXPECT_EQ(times, (std::vector<double>{0.01, 0.02}));

  asked.keep_going = [](const SeriesRow&) { return true; };
  asked.resume = true;
  const SimulateOutcome rest = run_simulate(asked);
  EXPECT_EQ(rest.end, RunEnd::done);
  EXPECT_EQ(rest.windows, 4U);
  EXPECT_EQ(rest.windows_before, 2U);
}

/// A falling point has a breakpoint at each kick of gravity, so windows end early. The run is stopped after each one.
TEST_F(SimulateInProcess, GoesOnFromAWindowThatEndedEarly) {
  SimulateRequest asked = request();
  asked.scene = folder.write("falling.json", R"({
    "noli_scene": 1, "dimension": 2, "duration": 0.03, "window": 0.01, "gravity": [0, -10], "gravity_step": 1e-3,
    "most_breakpoints": 5,
    "bodies": [{"mesh": {"points": {"at": [[0, 0]]}}, "material": {"edge_stiffness": 1, "mass_per_vertex": 1}}]})");
  const SimulateOutcome whole = run_simulate(asked);
  EXPECT_EQ(whole.end, RunEnd::done);
  EXPECT_EQ(whole.windows, whole.windows_total);
  EXPECT_GE(whole.windows, 9U);

  SimulateRequest step_by_step = asked;
  step_by_step.run = folder / "steps";
  step_by_step.keep_going = [](const SeriesRow&) { return false; };
  std::uint64_t early = 0;
  for (std::uint64_t windows = 1; windows <= whole.windows; ++windows) {
    const SimulateOutcome outcome = run_simulate(step_by_step);
    step_by_step.resume = true;
    ASSERT_EQ(outcome.windows, windows);
    EXPECT_EQ(outcome.end, windows < whole.windows ? RunEnd::interrupted : RunEnd::done);
    EXPECT_LE(outcome.windows_total, whole.windows) << "more can end early yet";
    if (outcome.time != 0.01 && outcome.time != 0.02 && outcome.time != 0.03) ++early;
    VerifyRequest verify;
    verify.frames = {step_by_step.run};
    verify.run = true;
    const VerifyOutcome verified = run_verify(verify);
    EXPECT_EQ(verified.verdict, Verdict::no_contact);
    EXPECT_EQ(verified.ending->time, outcome.time);
    EXPECT_EQ(verified.ending->windows_total, outcome.windows_total);
  }
  EXPECT_EQ(early, whole.windows - 3);
  const auto bytes = [](const std::filesystem::path& run) { return read_whole_file(run / "trajectory.blocks"); };
  EXPECT_TRUE(bytes(step_by_step.run) == bytes(asked.run));
}

TEST_F(SimulateInProcess, AConditionAtTheEndChangesNothing) {
  SimulateRequest asked = request();
  asked.keep_going = [](const SeriesRow& row) { return row.time < 0.035; };
  EXPECT_EQ(run_simulate(asked).end, RunEnd::done);
}

TEST_F(SimulateInProcess, TellsItsProgress) {
  std::vector<double> shares;
  SimulateRequest asked = request();
  asked.progress = [&](std::string_view work, double share) {
    if (work == "simulate") shares.push_back(share);
  };
  run_simulate(asked);
  ASSERT_FALSE(shares.empty());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    EXPECT_GE(shares[i], i == 0 ? 0 : shares[i - 1]);
    EXPECT_LE(shares[i], 1);
  }
}

TEST_F(SimulateInProcess, TellsOfTheSceneBeforeItBegins) {
  SimulateRequest asked = request();
  bool began = false;
  std::vector<SimulateStart> starts;
  asked.begins = [&](const SimulateStart& start) {
    EXPECT_FALSE(began);
    starts.push_back(start);
  };
  asked.keep_going = [&](const SeriesRow&) { return began = true; };
  run_simulate(asked);
  asked.scene = folder.write("short.json", std::string(resting_bar).insert(1, R"("short": {"/duration": 0.02}, )"));
  asked.run = folder / "short";
  began = false;
  run_simulate(asked);
  ASSERT_EQ(starts.size(), 2U);
  EXPECT_FALSE(starts[0].has_short_form);
  EXPECT_TRUE(starts[1].has_short_form);
  EXPECT_EQ(starts[0].notes, std::vector<std::string>());
  EXPECT_NE(starts[0].space, "");
}

TEST_F(SimulateInProcess, VerifyingARunTellsItsProgress) {
  SimulateRequest asked = request();
  run_simulate(asked);
  VerifyRequest verify;
  verify.frames = {asked.run};
  verify.run = true;
  std::vector<double> shares;
  verify.progress = [&](std::string_view work, double share) {
    EXPECT_EQ(work, "verify");
    shares.push_back(share);
  };
  EXPECT_EQ(run_verify(verify).verdict, Verdict::no_contact);
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1);
}

TEST_F(SimulateInProcess, ErrorsAreExceptions) {
  SimulateRequest asked = request();
  run_simulate(asked);
  EXPECT_THROW(run_simulate(asked), UsageError);  // the run exists
  asked.scene = folder.write("none.json", "{}");
  asked.run = folder / "other";
  EXPECT_THROW(run_simulate(asked), InputError);
}

/// Each window of a run, whether it recorded world lines or only frames.
TEST_F(SimulateInProcess, ReproducesWindows) {
  for (const char* const record : {"full", "frames"}) {
    SimulateRequest asked = request();
    std::string scene = resting_bar;
    scene.insert(scene.find("\"bodies\""), std::string("\"record\": \"") + record + "\", ");
    asked.scene = folder.write("recorded.json", scene);
    asked.run = folder / record;
    ASSERT_EQ(run_simulate(asked).windows, 4U) << record;
    const std::vector<std::string> files = folder.names();
    for (std::uint64_t window = 1; window <= 4; ++window) {
      const ReproduceOutcome outcome = run_reproduce({.scene = asked.scene, .run = asked.run, .window = window});
      EXPECT_TRUE(outcome.same) << record << ' ' << window;
      EXPECT_EQ(outcome.found, outcome.expected);
      EXPECT_GE(outcome.breakpoints, 4U);
    }
    EXPECT_EQ(folder.names(), files);
  }
}

TEST_F(SimulateInProcess, WritesTheBlockOfAReproducedWindow) {
  const SimulateRequest asked = request();
  run_simulate(asked);
  const ReproduceOutcome outcome =
      run_reproduce({.scene = asked.scene, .run = asked.run, .window = 2, .output = folder / "block"});
  EXPECT_EQ(sha256(read_whole_file(folder / "block")), outcome.found);
}

TEST_F(SimulateInProcess, AnotherSceneIsNotReproduced) {
  const SimulateRequest asked = request();
  run_simulate(asked);
  std::string falling = resting_bar;
  falling.replace(falling.find("[0, 0]"), 6, "[0, -9]");
  const ReproduceOutcome outcome =
      run_reproduce({.scene = folder.write("falling.json", falling), .run = asked.run, .window = 1});
  EXPECT_FALSE(outcome.same);
  EXPECT_NE(outcome.found, outcome.expected);
  EXPECT_THROW(run_reproduce({.scene = asked.scene, .run = asked.run, .window = 5}), InputError);
  EXPECT_THROW(run_reproduce({.scene = asked.scene, .run = asked.run, .window = 0}), UsageError);
  EXPECT_THROW(run_reproduce({.scene = asked.scene, .run = folder / "none", .window = 1}), InputError);
}

TEST_F(SimulateInProcess, ReproducingTellsItsProgress) {
  const SimulateRequest asked = request();
  run_simulate(asked);
  std::vector<std::string> told;
  run_reproduce(
      {.scene = asked.scene, .run = asked.run, .window = 2, .progress = [&](std::string_view work, double share) {
         told.push_back(std::string(work) + ' ' + std::to_string(share).substr(0, 3));
       }});
  EXPECT_EQ(told, (std::vector<std::string>{"read 0.5", "read 1.0", "integrate 0.0", "integrate 1.0"}));
}

TEST_F(SimulateInProcess, AStopOfItsOwnEndsReproducing) {
  const SimulateRequest asked = request();
  run_simulate(asked);
  std::atomic<bool> stop = false;
  ReproduceRequest again{
      .scene = asked.scene, .run = asked.run, .window = 3, .output = folder / "block", .stop = &stop};
  for (const std::string_view at : {"read", "integrate"}) {
    stop = false;
    again.progress = [&](std::string_view work, double) { stop = work == at; };
    EXPECT_THROW(run_reproduce(again), Stopped) << at;
    EXPECT_FALSE(std::filesystem::exists(folder / "block")) << at;
  }
  stop = false;
  again.progress = nullptr;
  EXPECT_TRUE(run_reproduce(again).same);
}

TEST_F(SimulateInProcess, AStopOfItsOwnWhileItReadsTheSceneLeavesNoFolder) {
  const std::atomic<bool> stop = true;
  SimulateRequest asked = request();
  asked.stop = &stop;
  EXPECT_THROW(run_simulate(asked), Stopped);
  EXPECT_FALSE(std::filesystem::exists(asked.run));
}

TEST_F(SimulateInProcess, AStopOfItsOwnEndsItAtTheLastWindow) {
  std::atomic<bool> stop = false;
  SimulateRequest asked = request();
  asked.stop = &stop;
  asked.keep_going = [&](const SeriesRow&) {
    stop = true;
    return true;
  };
  const SimulateOutcome outcome = run_simulate(asked);
  EXPECT_EQ(outcome.end, RunEnd::interrupted);
  EXPECT_LT(outcome.windows, outcome.windows_total);
}

}  // namespace
}  // namespace noli
