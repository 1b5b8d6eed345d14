// SPDX-License-Identifier: Apache-2.0
//
// Checkers and frames that they do not read themselves: those get to them as a block file of frames, on a pipe or in a
// file that vanishes.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <noli/frames.h>
#include "certify/proofs/checker.h"
#include "trajectory/formats/frame_source.h"

namespace noli {

/// Whether checkers read this motion themselves: PLY and OBJ files, or one block file; of one mesh, and not in memory.
bool checkers_read(const std::vector<std::filesystem::path>& frames, const FrameReading& reading);

/// Has a checker look at a proof in a file, and gives it the frames; those of `request.trajectory` are not used. One
/// frame is in memory at a time; for the verified checker, which measures its files, all are in a file for a while.
/// Nothing after a stop. Precondition: request.proof. Throws what CheckerProcess and the frames throw.
std::optional<CheckerVerdict> check_frames(CheckRequest request, FrameSource& frames);

/// Whether the checker reads these files itself. It also gets a single file whose name and first bytes are of no known
/// kind, and refuses it.
bool left_to_checkers(const std::vector<std::filesystem::path>& files, const FrameReading& reading);

/// Checks a proof in a file about the motion in `request.trajectory`: by check_proof() if left_to_checkers(), otherwise
/// by check_frames(). Precondition: request.proof. Throws what these throw, and Stopped after a stop.
CheckerVerdict check_motion(const CheckRequest& request, const FrameReading& reading);

}  // namespace noli
