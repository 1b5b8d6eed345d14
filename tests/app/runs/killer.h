// SPDX-License-Identifier: Apache-2.0
//
// Kills runs at random moments until they are done.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace noli::app_tests {

/// A running `noli` without standard output.
class Victim {
 public:
  explicit Victim(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "noli");
    std::vector<char*> argv;
    for (std::string& word : arguments) argv.push_back(word.data());
    argv.push_back(nullptr);
    child_ = ::fork();
    if (child_ != 0) return;
    std::freopen("/dev/null", "w", stdout);
    ::execv(NOLI_COMMAND, argv.data());
    ::_exit(127);
  }
  void kill_after(std::chrono::microseconds pause) const {
    std::this_thread::sleep_for(pause);
    ::kill(child_, SIGKILL);
  }
  /// The exit code; nullopt if it was killed.
  std::optional<int> wait() const {
    int status = 0;
    ::waitpid(child_, &status, 0);
    return WIFEXITED(status) ? std::optional(WEXITSTATUS(status)) : std::nullopt;
  }

 private:
  pid_t child_;
};

/// Starts `noli` with these arguments and kills it after a pause. True if it exited with 0 before.
inline bool run_and_kill(const std::vector<std::string>& arguments, std::chrono::microseconds pause) {
  const Victim victim(arguments);
  victim.kill_after(pause);
  return victim.wait() == 0;
}

/// Starts `simulate` with these arguments and kills it after pause(), up to `most` times; then lets it end. Returns the
/// number of kills, or -1 if the exit code was not 0.
inline int kill_until_done(const std::vector<std::string>& arguments, const std::string& run, int most,
                           const std::function<std::chrono::microseconds()>& pause) {
  for (int kills = 0;; ++kills) {
    std::vector<std::string> command{"simulate"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.insert(command.end(), {"-o", run, std::filesystem::exists(run) ? "--resume" : "--force"});
    const Victim victim(command);
    if (kills < most) victim.kill_after(pause());
    if (const auto code = victim.wait()) return code == 0 ? kills : -1;
  }
}

}  // namespace noli::app_tests
