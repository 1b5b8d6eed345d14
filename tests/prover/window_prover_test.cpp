// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>

#include "proofs/prover/tokens/no_proof.h"
#include "proofs/prover/windows/window_verifier.h"
#include "window_scenes.h"

namespace noli::testing {
namespace {

/// A point that circles another one, a quarter turn from breakpoint to breakpoint.
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
  WindowOptions window;
  window.dimension = 2;
  const std::vector<Position> x = {scene.paths[0][0].x, scene.paths[1][0].x};
  const WindowVerifier verifier(scene.mesh, x, window);
  Written written{false, 0};
  written.whole =
      verifier.prove(scene.lines(), options, {}, [&](std::string_view bytes) { written.bytes += bytes.size(); });
  return written;
}

TEST(WindowProver, TwoPointsWithManyBreakpointsNeedADirectionForEachQuarterAtLeast) {
  const Written written = prove(orbit(2048), {});
  EXPECT_TRUE(written.whole);
  EXPECT_GE(written.bytes, 1024u) << "each direction holds for less than half a round";
}

TEST(WindowProver, LooksForAStopWithinOnePairOfCells) {
  std::atomic<bool> stop = true;
  VerifyOptions options;
  options.stop = &stop;
  EXPECT_FALSE(prove(orbit(2048), options).whole);
  stop = false;
  options.deadline = std::chrono::steady_clock::now() - std::chrono::seconds(1);
  EXPECT_FALSE(prove(orbit(2048), options).whole);
}

TEST(WindowProver, TwoPointsThatMeetHaveNoProof) {
  LineScene scene = orbit(4);
  scene.paths[0][2].x = {0, 0, 0};
  EXPECT_THROW(prove(scene, {}), NoProof);
}

}  // namespace
}  // namespace noli::testing
