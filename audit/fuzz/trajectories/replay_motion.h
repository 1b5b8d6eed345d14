// SPDX-License-Identifier: Apache-2.0
//
// Judges a saved motion again, and makes it smaller: by noli's own answers, or by those of somebody else's library.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "audit/ccd/library_answers.h"
#include "audit/fuzz/trajectories/frame_motion.h"

namespace noli::audit {

struct ReplayedMotion {
  FrameMotion motion;                     ///< smaller if that was asked for and something is wrong with it
  std::optional<std::string> difference;  ///< what is wrong with the answers to `motion`, in words
  bool undecided = false;                 ///< noli's time was up
};

/// Asks `noli verify` and both checkers. `smaller`: the motion is made smaller if something is wrong. Throws what
/// VerifyProgram throws (audit/fuzz/trajectories/verify_program.h).
ReplayedMotion replay_motion(FrameMotion motion, bool smaller, const std::atomic<bool>& stop);

/// Asks a library, also for leaks. Throws InputError for a library that cannot be used, and what ask_motion throws.
ReplayedMotion replay_motion(const LibraryUnderTest& library, FrameMotion motion, bool smaller);

}  // namespace noli::audit
