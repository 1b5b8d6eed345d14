// SPDX-License-Identifier: Apache-2.0
//
// Runs that are killed at random moments until they are done.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace noli::app_tests {

/// Starts `noli` with these arguments and kills it after a pause, unless it has ended. Whether it ended well.
inline bool run_and_kill(std::vector<std::string> arguments, std::chrono::microseconds pause) {
  arguments.insert(arguments.begin(), "noli");
  std::vector<char*> argv;
  for (std::string& word : arguments) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    std::freopen("/dev/null", "w", stdout);
    ::execv(NOLI_COMMAND, argv.data());
    ::_exit(127);
  }
  std::this_thread::sleep_for(pause);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Starts `simulate` with these arguments and kills it after pause(), again and again, `most` times; then lets it end.
/// Returns how often it killed it, or -1 if it did not end well.
inline int kill_until_done(const std::vector<std::string>& arguments, const std::string& run, int most,
                           const std::function<std::chrono::microseconds()>& pause) {
  int kills = 0;
  for (;;) {
    std::vector<std::string> command{"noli", "simulate"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.insert(command.end(), {"-o", run, std::filesystem::exists(run) ? "--resume" : "--force"});
    std::vector<char*> argv;
    argv.reserve(command.size() + 1);
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
      std::freopen("/dev/null", "w", stdout);
      ::execv(NOLI_COMMAND, argv.data());
      ::_exit(127);
    }
    if (kills < most) {
      std::this_thread::sleep_for(pause());
      ::kill(child, SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? kills : -1;
    ++kills;
  }
}

}  // namespace noli::app_tests
