// SPDX-License-Identifier: Apache-2.0
//
// Tests the windows that a repair keeps: the motion as it was filtered, or straight lines between its frames where that
// motion touches.
#include "certify/repair/repaired_run.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <string>

#include "certify/process/scratch_folder.h"
#include "certify/repair/step_lines.h"

namespace noli {
namespace {

/// A triangle above another one, at this height.
std::vector<Position> at(double z) { return {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, z}, {2, 1, z}, {1, 2, z}}; }

/// The upper triangle goes through these heights at 0, 1/2, 3/4 and 1.
FilteredStep through(const std::array<double, 4>& heights) {
  constexpr std::array times = {0.0, 0.5, 0.75, 1.0};
  std::vector<std::size_t> offsets = {0};
  std::vector<double> all_times;
  std::vector<Position> positions;
  for (VertexId v = 0; v < 6; ++v) {
    for (std::size_t k = 0; k < 4; ++k) {
      all_times.push_back(times[k]);
      positions.push_back(at(heights[k])[v]);
    }
    offsets.push_back(all_times.size());
  }
  FilteredStep step;
  step.pieces.push_back({0, WorldLines::from_breakpoints(offsets, all_times, positions, "test")});
  step.end = at(heights[3]);
  return step;
}

class RepairedRunTest : public testing::Test {
 protected:
  explicit RepairedRunTest(const WindowOptions& options = {}) {
    RepairedScene scene;
    scene.run.mesh.vertex_count = 6;
    scene.run.mesh.faces = {{0, 1, 2}, {3, 4, 5}};
    scene.run.header.window_length = 1;
    scene.run.labels.assign(6, 0);
    run_.emplace(folder_.path() / "run", scene, options);
    run_->claim(false, false);
    run_->begin();
  }
  RunWindow window() const {
    RunReader reader(folder_.path() / "run");
    return reader.next_window().value();
  }

  ScratchFolder folder_;
  std::optional<RepairedRun> run_;
};

TEST_F(RepairedRunTest, KeepsTheMotionThatWasFiltered) {
  EXPECT_TRUE(run_->add(through({1, 0.5, 0.25, 0.5}), at(1), std::array{0.5, 1.0}));
  EXPECT_EQ(run_->straight_windows(), 0u);
  EXPECT_EQ(window().lines->positions(3)[2], at(0.25)[3]);
}

TEST_F(RepairedRunTest, GoesStraightFromFrameToFrameWhereThatTouches) {
  EXPECT_TRUE(run_->add(through({1, 0.5, -0.25, 0.5}), at(1), std::array{0.5, 1.0}));
  EXPECT_EQ(run_->straight_windows(), 1u);
  const RunWindow kept = window();
  ASSERT_EQ(kept.lines->times(3).size(), 3u);
  EXPECT_EQ(kept.lines->positions(3)[1], at(0.5)[3]);
  EXPECT_EQ(kept.positions, at(0.5));
}

const std::atomic<bool> asked_to_stop = true;

class StoppedRepairedRun : public RepairedRunTest {
 protected:
  StoppedRepairedRun() : RepairedRunTest(stopped()) {}
  static WindowOptions stopped() {
    WindowOptions options;
    options.stop = &asked_to_stop;
    return options;
  }
};

TEST_F(StoppedRepairedRun, KeepsNothing) {
  EXPECT_FALSE(run_->add(through({1, 0.5, 0.25, 0.5}), at(1), std::array{0.5, 1.0}));
  RunReader reader(folder_.path() / "run");
  EXPECT_FALSE(reader.next_window());
}

/// One vertex along x.
FilteredStep::Piece along_x(double begin, const std::vector<double>& times, const std::vector<double>& x) {
  std::vector<Position> positions;
  for (const double coordinate : x) positions.push_back({coordinate, 0, 0});
  return {begin, WorldLines::from_breakpoints({0, times.size()}, times, positions, "test")};
}

std::vector<double> x_of(const WorldLines& lines) {
  std::vector<double> x;
  for (const Position& position : lines.positions(0)) x.push_back(position[0]);
  return x;
}

std::vector<double> times_of(const WorldLines& lines) { return {lines.times(0).begin(), lines.times(0).end()}; }

const std::vector<Position> origin = {{0, 0, 0}};

TEST(StepLines, JoinsPiecesAndEndsWhereTheStepDoes) {
  FilteredStep step;
  step.end = {{8, 0, 0}};
  step.pieces.push_back(along_x(0, {0, 0.25, 0.5}, {0, 1, 2}));
  step.pieces.push_back(along_x(0.5, {0, 0.25, 0.5}, {2, 3, 4}));
  const WorldLines lines = lines_of_step(step, origin, 3, 3);
  EXPECT_EQ(times_of(lines), (std::vector<double>{3, 3.25, 3.5, 3.75, 4}));
  EXPECT_EQ(x_of(lines), (std::vector<double>{0, 1, 2, 3, 8}));
}

TEST(StepLines, TheLastOfTheBreakpointsAtOneTimeCounts) {
  // At the time 2^30 the next double is 2^-22 later.
  constexpr std::size_t k = std::size_t{1} << 30;
  FilteredStep step;
  step.end = {{4, 0, 0}};
  step.pieces.push_back(along_x(0, {0, 0x1p-30, 0.5, 0.5 + 0x1p-30, 1}, {0, 1, 2, 3, 4}));
  const WorldLines lines = lines_of_step(step, origin, k, 3);
  EXPECT_EQ(times_of(lines), (std::vector<double>{0x1p30, 0x1p30 + 0.5, 0x1p30 + 1}));
  EXPECT_EQ(x_of(lines), (std::vector<double>{0, 3, 4}));
}

TEST(StepLines, APhaseMayBeginARoundingEarly) {
  FilteredStep step;
  step.end = {{4, 0, 0}};
  step.pieces.push_back(along_x(0, {0, 0.5}, {0, 2}));
  step.pieces.push_back(along_x(0.5 - 0x1p-53, {0, 0x1p-54}, {2, 3}));
  const WorldLines lines = lines_of_step(step, origin, 0, 3);
  EXPECT_EQ(times_of(lines), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(x_of(lines), (std::vector<double>{0, 3, 4}));
}

}  // namespace
}  // namespace noli
