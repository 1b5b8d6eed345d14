// SPDX-License-Identifier: Apache-2.0
//
// `noli fuzz trajectories --library`: a run, and a saved motion again, against somebody else's library.
#pragma once

#include "app/audit/library_options.h"
#include "app/exit_code.h"
#include "app/fuzz/fuzz_options.h"
#include "audit/fuzz/trajectories/frame_motion.h"

namespace noli::app {

struct LibraryMotionArguments {
  FuzzArgumentsInCommon common;
  ReplayArguments replay;
  LibraryArguments theirs;
  std::size_t max_findings = 20;
  std::vector<std::string> families;  ///< names of generators; none: all of them
};

/// How large a motion is: frames, cells, vertices.
Json motion_facts(const audit::FrameMotion& motion);

/// Throws UsageError, InputError.
ExitCode fuzz_motions_of_library(LibraryMotionArguments arguments);

/// --replay or --minimise, whichever was given.
ExitCode replay_motion_of_library(LibraryMotionArguments arguments);

}  // namespace noli::app
