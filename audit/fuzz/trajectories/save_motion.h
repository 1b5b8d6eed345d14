// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "audit/fuzz/trajectories/frame_motion.h"

namespace noli::audit {

/// A finding as a folder: its frames, and a README with what is wrong and with the words of the command that shows it
/// again, to which the folder is added. All of it or nothing (audit/fuzz/save_whole.h). Throws std::system_error.
void save_motion(const FrameMotion& motion, const std::string& difference, std::vector<std::string> replay_command,
                 const std::filesystem::path& folder);

}  // namespace noli::audit
