// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/save_motion.h"

#include <fmt/format.h>

#include "audit/fuzz/save_whole.h"
#include "certify/process/run_program.h"
#include "trajectory/write_file.h"

namespace noli::audit {

void save_motion(const FrameMotion& motion, const std::string& difference, std::vector<std::string> replay_command,
                 const std::filesystem::path& folder) {
  replay_command.push_back(folder.string());
  save_whole(folder, [&](const std::filesystem::path& to) {
    write_frames(motion, to);
    write_file(to / "README", fmt::format("{}\nShown again by\n  {}\n", difference, shell_words(replay_command)));
  });
}

}  // namespace noli::audit
