// SPDX-License-Identifier: Apache-2.0
//
// Exports runs through the public interface: frames, progress, stops.
#include <noli/export.h>
#include <noli/simulate.h>

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <future>
#include <iterator>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "tests/support/temporary_folder.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

/// A bar in the plane at rest; takes four windows.
constexpr const char* still_bar = R"({
  "noli_scene": 1, "dimension": 2, "duration": 0.04, "window": 0.01, "gravity": [0, 0],
  "bodies": [{"name": "bar", "mesh": {"chain": {"points": [[0, 0], [1, 0]], "segments": 1}}, "steps": {"stretch": 1e-3},
              "material": {"edge_stiffness": 1, "mass_per_vertex": 1}}]})";

class ExportInProcess : public testing::Test {
 protected:
  /// Of a run of four windows, each with some frames.
  ExportRequest request(const std::string& frames = "frames") const {
    if (!std::filesystem::exists(folder / "run")) {
      SimulateRequest simulate;
      simulate.scene = folder.write("scene.json", still_bar);
      simulate.run = folder / "run";
      simulate.threads = 1;
      run_simulate(simulate);
    }
    return {.run = folder / "run", .fps = 1000, .pattern = (folder / frames / "%03d.obj").string()};
  }

  std::size_t files(const std::string& frames = "frames") const {
    const std::filesystem::path path = folder / frames;
    if (!std::filesystem::exists(path)) return 0;
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path), {}));
  }

  test::TemporaryFolder folder;
};

TEST_F(ExportInProcess, FinishesWithoutAStop) {
  ExportRequest asked = request();
  std::vector<double> shares;
  asked.progress = [&](double share) { shares.push_back(share); };
  const std::atomic<bool> stop = false;
  for (const auto* const of_its_own : {static_cast<const std::atomic<bool>*>(nullptr), &stop}) {
    asked.stop = of_its_own;
    const ExportOutcome outcome = run_export(asked);
    EXPECT_FALSE(outcome.interrupted);
    EXPECT_EQ(outcome.windows, 4U);
    EXPECT_GE(outcome.frames, 40U);
    EXPECT_EQ(files(), outcome.frames);
    asked.force = true;
  }
  EXPECT_EQ(shares, (std::vector<double>{0.25, 0.5, 0.75, 1, 0.25, 0.5, 0.75, 1}));
}

TEST_F(ExportInProcess, AStopBeforeTheFirstFrameLeavesNoFile) {
  ExportRequest asked = request();
  const std::atomic<bool> stop = true;
  asked.stop = &stop;
  try {
    run_export(asked);
    FAIL() << "was not stopped";
  } catch (const Stopped& stopped) {
    EXPECT_EQ(stopped.reason(), StopReason::interrupted);
    EXPECT_EQ(stopped.what(), asked.run.string() + ": interrupted");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "frames"));
}

TEST_F(ExportInProcess, AStopBeforeTheFirstFrameLeavesEarlierFiles) {
  ExportRequest asked = request();
  const std::uint64_t frames = run_export(asked).frames;
  const std::atomic<bool> stop = true;
  asked.stop = &stop;
  asked.force = true;
  EXPECT_THROW(run_export(asked), Stopped);
  EXPECT_EQ(files(), frames);
  asked.stop = nullptr;
  const StopOfThread from_outside(stop);
  EXPECT_THROW(run_export(asked), Stopped);
  EXPECT_EQ(files(), frames);
}

TEST_F(ExportInProcess, ALaterStopLeavesTheFramesSoFar) {
  ExportRequest asked = request();
  std::atomic<bool> stop = false;
  asked.stop = &stop;
  asked.progress = [&](double share) { stop = share >= 0.5; };
  const ExportOutcome outcome = run_export(asked);
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_EQ(outcome.windows, 2U);
  EXPECT_EQ(outcome.end, 0.02);
  EXPECT_GE(outcome.frames, 20U);
  EXPECT_LT(outcome.frames, 30U);
  EXPECT_EQ(files(), outcome.frames);
}

TEST_F(ExportInProcess, TwoAtOnceHaveStopsOfTheirOwn) {
  const ExportRequest goes_on = request("whole");
  ExportRequest stopped = request("part");
  std::atomic<bool> stop = false;
  stopped.stop = &stop;
  stopped.progress = [&](double) { stop = true; };
  auto other = std::async(std::launch::async, [&] { return run_export(goes_on); });
  EXPECT_TRUE(run_export(stopped).interrupted);
  const ExportOutcome whole = other.get();
  EXPECT_FALSE(whole.interrupted);
  EXPECT_EQ(whole.windows, 4U);
  EXPECT_EQ(files("whole"), whole.frames);
  EXPECT_LT(files("part"), whole.frames);
}

}  // namespace
}  // namespace noli
