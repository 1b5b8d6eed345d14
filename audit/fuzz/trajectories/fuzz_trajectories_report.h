// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of `noli fuzz trajectories` as text and JSON: about noli itself, and about somebody else's
// library.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "audit/fuzz/trajectories/fuzz_library_motions.h"
#include "audit/fuzz/trajectories/fuzz_trajectories.h"
#include "certify/json.h"

namespace noli::audit {

/// Without `timing`.
Json fuzz_json(const TrajectoryOptions& options, const TrajectoryReport& report);
std::string fuzz_text(const TrajectoryOptions& options, const TrajectoryReport& report);
/// Members of that JSON for the line of --porcelain; the report only selects the overload.
std::vector<std::string> fuzz_pairs(const TrajectoryReport& report);

/// The same of a library. Precondition: the options have `replay_command`.
Json fuzz_json(const LibraryMotionOptions& options, const LibraryMotionReport& report);
std::string fuzz_text(const LibraryMotionOptions& options, const LibraryMotionReport& report);
std::vector<std::string> fuzz_pairs(const LibraryMotionReport& report);

/// How large a motion is: frames, cells, vertices.
Json motion_facts(const FrameMotion& motion);

/// The command with this folder behind it, as one line for a shell.
std::string replay_line(std::vector<std::string> command, const std::filesystem::path& folder);

}  // namespace noli::audit
