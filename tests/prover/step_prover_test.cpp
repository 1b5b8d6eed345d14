// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/step_prover.h"

#include <gtest/gtest.h>

#include <atomic>

#include "window_scenes.h"

namespace noli::testing {
namespace {

/// A point that goes round another one, a quarter of a round from breakpoint to breakpoint.
LineScene orbit(int quarters) {
  const Position places[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  std::vector<Breakpoint> path;
  for (int k = 0; k <= quarters; ++k) path.push_back({static_cast<double>(k), places[k % 4]});
  LineScene scene;
  scene.mesh.points = {scene.vertex(path), scene.vertex(Position{0, 0, 0})};
  return scene;
}

struct Written {
  bool whole;
  std::size_t bytes;
};

Written prove(const LineScene& scene, const VerifyOptions& options) {
  const std::vector<std::uint32_t> order = {0, 1}, ends = {2}, labels = {0, 0};
  const StepProver prover(scene.mesh, order, ends, labels, {2, false, {}, 0, 1});
  Written written{false, 0};
  written.whole = prover.prove(scene.lines(), options, [&](std::string_view bytes) { written.bytes += bytes.size(); });
  return written;
}

TEST(StepProver, TwoPointsWithManyBreakpointsNeedADirectionForEachQuarterAtLeast) {
  const Written written = prove(orbit(2048), {});
  EXPECT_TRUE(written.whole);
  EXPECT_GE(written.bytes, 1024u) << "each direction holds for less than half a round";
}

TEST(StepProver, LooksForAStopWithinOnePairOfCells) {
  std::atomic<bool> stop = true;
  VerifyOptions options;
  options.stop = &stop;
  EXPECT_FALSE(prove(orbit(2048), options).whole);
  stop = false;
  options.deadline = std::chrono::steady_clock::now() - std::chrono::seconds(1);
  EXPECT_FALSE(prove(orbit(2048), options).whole);
}

TEST(StepProver, TwoPointsThatMeetHaveNoProof) {
  LineScene scene = orbit(4);
  scene.paths[0][2].x = {0, 0, 0};
  EXPECT_THROW(prove(scene, {}), NoProof);
}

}  // namespace
}  // namespace noli::testing
