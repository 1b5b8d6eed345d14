// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/replay_motion.h"

#include <cstddef>
#include <utility>

#include "audit/fuzz/trajectories/fuzz_library_motions.h"
#include "audit/fuzz/trajectories/verify_program.h"

namespace noli::audit {
namespace {

constexpr std::size_t replay_shrink_budget = 5000;

}  // namespace

ReplayedMotion replay_motion(FrameMotion motion, bool smaller, const std::atomic<bool>& stop) {
  VerifyProgram subject(1, stop);
  bool undecided = false;  // the last one, in the time that there was
  const auto decide = [&](const FrameMotion& one) {
    MotionAnswer answer = subject(one);
    undecided = answer.undecided;
    return answer;
  };
  const auto what = [&](const FrameMotion& candidate) { return difference(candidate, decide, &stop); };
  auto found = what(motion);
  if (found && smaller) {
    const std::string kind(kind_of(*found));
    motion = minimise(
        motion, [&](const FrameMotion& candidate) { return is_of_kind(what(candidate), kind); }, replay_shrink_budget);
    if (auto still = what(motion)) found = std::move(still);
  }
  return {std::move(motion), std::move(found), undecided};
}

ReplayedMotion replay_motion(const LibraryUnderTest& library, FrameMotion motion, bool smaller) {
  require_ccd_library(library.path, library.host);
  const bool times = knows_times(library);
  auto found = ask_motion(library, motion, {}, {times, true}).found;
  if (found && smaller) {
    ShrunkMotion shrunk = shrink_for_library(library, motion, *found, times, replay_shrink_budget);
    motion = std::move(shrunk.motion);
    found = std::move(shrunk.found);
  }
  return {std::move(motion), found ? std::optional(std::move(found->words)) : std::nullopt};
}

}  // namespace noli::audit
