// SPDX-License-Identifier: Apache-2.0
#include "noli/app/checker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "noli/trajectory/run_file.h"

extern char** environ;

namespace noli::app {
namespace {

namespace fs = std::filesystem;

const char* name_of(Checker checker) { return checker == Checker::plain ? "noli_check" : "noli_check_verified"; }

/// The checker lies beside this program.
fs::path path_of(Checker checker) {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path path = self.parent_path() / name_of(checker);
  if (error || ::access(path.c_str(), X_OK) != 0) {
    throw std::runtime_error(
        fmt::format("the checker {} is not there; expected it beside this program", path.string()));
  }
  return path;
}

/// A pipe; both ends are closed with it.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "a pipe");
  }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int end(std::size_t i) const { return ends_[i]; }
  void close(std::size_t i) {
    if (ends_[i] >= 0) ::close(ends_[i]);
    ends_[i] = -1;
  }
  std::string read_all() const {
    std::string text;
    std::array<char, 4096> part;
    for (;;) {
      const ssize_t got = ::read(ends_[0], part.data(), part.size());
      if (got > 0) text.append(part.data(), static_cast<std::size_t>(got));
      if (got == 0) return text;
      if (got < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "the checker's words");
    }
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// Starts a program whose standard output goes to the pipe.
pid_t start(const std::vector<std::string>& arguments, const Pipe& pipe) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe.end(1), STDOUT_FILENO);
  pid_t pid = 0;
  const int error = ::posix_spawn(&pid, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::system_error(error, std::generic_category(), arguments[0]);
  return pid;
}

int wait_for(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waiting for the checker");
  }
  return status;
}

}  // namespace

CheckerVerdict run_checker(Checker checker, const fs::path& proof, const std::vector<fs::path>& trajectory) {
  std::vector<std::string> arguments = {path_of(checker).string(), proof.string()};
  for (const fs::path& path : trajectory) arguments.push_back(path.string());
  Pipe pipe;
  const pid_t pid = start(arguments, pipe);
  pipe.close(1);
  CheckerVerdict verdict;
  verdict.words = pipe.read_all();
  const int status = wait_for(pid);
  if (WIFSIGNALED(status)) {
    throw std::runtime_error(fmt::format("{} was ended by signal {}", name_of(checker), WTERMSIG(status)));
  }
  verdict.code = WEXITSTATUS(status);
  if (verdict.code != 0 && verdict.code != 1 && verdict.code != 3) {
    throw std::runtime_error(fmt::format("{} ended with code {}; expected 0, 1 or 3", name_of(checker), verdict.code));
  }
  return verdict;
}

std::vector<fs::path> trajectory_for_checker(const std::vector<fs::path>& trajectory) {
  if (trajectory.size() == 1 && fs::is_directory(trajectory[0])) return {trajectory_path(trajectory[0])};
  return trajectory;
}

}  // namespace noli::app
