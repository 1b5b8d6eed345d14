// SPDX-License-Identifier: Apache-2.0
#include "certify/process/start_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

extern char** environ;

namespace noli {
namespace {

/// Waits for it.
int status_of(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waiting for a program");
  }
  return status;
}

}  // namespace

void require_startable(const std::string& program) {
  if (::access(program.c_str(), X_OK) == 0) return;
  throw std::system_error(errno, std::generic_category(), program + " cannot be started");
}

pid_t start_process(std::vector<std::string> words, std::span<const GivenDescriptor> descriptors) {
  require_startable(words[0]);
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
  if (error != 0) throw std::system_error(error, std::generic_category(), words[0] + " cannot be started");
  return pid;
}

bool has_ended(pid_t pid) {
  siginfo_t info = {};
  const int error = ::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT);
  if (error != 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "waiting for a program");
  return error == 0 && info.si_pid == pid;
}

std::optional<int> wait_for_end(pid_t pid, std::chrono::milliseconds patience, const std::function<bool()>& stop) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!has_ended(pid)) {
    if (std::chrono::steady_clock::now() >= deadline || stop()) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return status_of(pid);
}

void take_words(std::string& words, std::string_view next) {
  if (words.size() > most_words) return;  // the note is there
  words.append(next.substr(0, most_words - words.size()));
  if (words.size() < most_words) return;
  words += "\n[cut off after 1 MB]\n";
}

int end_process(pid_t pid, std::chrono::milliseconds patience) {
  const auto signal = [pid](int number) {
    ::kill(-pid, number);
    ::kill(pid, number);  // before it has a group of its own
  };
  const auto deadline = std::chrono::steady_clock::now() + patience;
  if (patience.count() > 0) signal(SIGTERM);
  while (std::chrono::steady_clock::now() < deadline && !has_ended(pid))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  signal(SIGKILL);
  return status_of(pid);
}

}  // namespace noli
