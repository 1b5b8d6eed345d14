// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/start_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <stdexcept>
#include <system_error>

extern char** environ;

namespace noli::audit {

pid_t start_process(std::vector<std::string> words, std::span<const GivenDescriptor> descriptors) {
  if (::access(words[0].c_str(), X_OK) != 0) {
    throw std::runtime_error(words[0] + " is not there; expected it beside this program");
  }
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const auto& [theirs, ours] : descriptors) {
    if (ours == GivenDescriptor::nothing) {
      posix_spawn_file_actions_addopen(&actions, theirs, "/dev/null", O_RDWR, 0);
    } else {
      posix_spawn_file_actions_adddup2(&actions, ours, theirs);
    }
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t pid = 0;
  const int error = ::posix_spawn(&pid, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::system_error(error, std::generic_category(), words[0]);
  return pid;
}

}  // namespace noli::audit
