// SPDX-License-Identifier: Apache-2.0
//
// Tests verdicts whose check is stopped.
#include "certify/proofs/proof_route.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "certify/process/this_program.h"
#include "certify/verify_work.h"

namespace noli {
namespace {

/// Verifies two triangles that are 0.5 apart in the first frame and `end` apart in the second; they have to stay 0.25
/// apart. The checker runs after both are decided, so the frames are read again; `when_again` is called then.
VerifyOutcome outcome_of(double end, std::atomic<bool>& stop, const std::function<void()>& when_again) {
  keep_programs_in(NOLI_PROGRAMS);
  auto given = std::make_shared<GivenFrames>();
  given->mesh.vertex_count = 6;
  given->mesh.faces = {{0, 1, 2}, {3, 4, 5}};
  given->count = 2;
  given->again = true;
  given->frame = [&, first_frames = 0](std::size_t k) mutable {
    if (k == 0 && ++first_frames > 1) when_again();
    const double z = k == 0 ? 0.5 : end;
    return std::optional(std::vector<Position>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, z}, {1, 0, z}, {0, 1, z}});
  };
  VerifyWork work;
  work.frames = {"frames"};
  work.reading.given = given;
  work.min_distance = 0.25;
  work.stop = &stop;
  ProofRoute route(work);
  VerifyOutcome outcome = run_verify(work);
  route.check(outcome);
  return outcome;
}

TEST(ProofRoute, FramesThatAreReadAgainAreChecked) {
  std::atomic<bool> stop = false;
  bool again = false;
  const VerifyOutcome outcome = outcome_of(0.4, stop, [&] { again = true; });
  EXPECT_TRUE(again);
  EXPECT_EQ(outcome.verdict, Verdict::proved);
  EXPECT_FALSE(outcome.interrupted);
}

TEST(ProofRoute, AStopWhileFramesAreReadAgainLeavesItUndecided) {
  std::atomic<bool> stop = false;
  const VerifyOutcome outcome = outcome_of(0.4, stop, [&] {
    stop = true;
    throw Stopped(StopReason::interrupted, "");
  });
  EXPECT_EQ(outcome.verdict, Verdict::undecided);
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_EQ(outcome.not_checked, "interrupted");
}

TEST(ProofRoute, AStopWhileFramesAreReadAgainKeepsWhatWasFound) {
  std::atomic<bool> stop = false;
  bool again = false;
  const VerifyOutcome outcome = outcome_of(0.125, stop, [&] {
    again = stop = true;
    throw Stopped(StopReason::interrupted, "");
  });
  EXPECT_TRUE(again);
  EXPECT_EQ(outcome.verdict, Verdict::too_near);
  EXPECT_EQ(outcome.not_checked, "interrupted");
}

}  // namespace
}  // namespace noli
