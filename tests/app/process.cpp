// SPDX-License-Identifier: Apache-2.0
#include "tests/app/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace noli::app_tests {
namespace {

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  }
  ~Pipe() {
    close_read();
    close_write();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_read() { close(ends_[0]); }
  void close_write() { close(ends_[1]); }

 private:
  static void close(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

void set_up_child(const ProcessOptions& options, const Pipe& out, const Pipe& err) {
  ::dup2(err.write_end(), STDERR_FILENO);
  if (!options.standard_output.empty()) {
    ::dup2(::open(options.standard_output.c_str(), O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
  } else {
    ::dup2(out.write_end(), STDOUT_FILENO);
  }
  // Only root has this capability, and may drop it.
  if (options.obey_permissions && ::geteuid() == 0 && ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0) != 0) {
    ::_exit(126);
  }
  if (options.close_standard_output) ::close(STDOUT_FILENO);
  for (const auto& [name, value] : options.environment) ::setenv(name.c_str(), value.c_str(), 1);
  if (options.file_size) limit_file_size(*options.file_size);
  if (options.address_space && !sanitized) {
    const struct rlimit limit = {*options.address_space, *options.address_space};
    ::setrlimit(RLIMIT_AS, &limit);
  }
}

pid_t start(const std::vector<std::string>& arguments, const ProcessOptions& options, const Pipe& out,
            const Pipe& err) {
  std::vector<std::string> words = {options.program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child > 0) return child;
  set_up_child(options, out, err);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

/// Whether the process has installed a handler for the signal.
bool catches(pid_t process, int signal) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    if (word != "SigCgt:") continue;
    status >> word;
    return (std::stoull(word, nullptr, 16) >> (signal - 1) & 1) != 0;
  }
  return false;
}

void send_signal(pid_t process, int signal, std::chrono::milliseconds after) {
  for (int wait = 0; wait < 100'000 && !catches(process, signal); ++wait)
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  std::this_thread::sleep_for(after);
  ::kill(process, signal);
}

bool read_some(int end, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t count = ::read(end, buffer.data(), buffer.size());
  if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0;
}

/// Reads both pipes until both are closed, in any order.
void read_all(const Pipe& out, const Pipe& err, Process& process) {
  std::array<struct pollfd, 2> ends = {{{out.read_end(), POLLIN, 0}, {err.read_end(), POLLIN, 0}}};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    ::poll(ends.data(), ends.size(), -1);
    if (ends[0].revents != 0 && !read_some(ends[0].fd, process.out)) ends[0].fd = -1;
    if (ends[1].revents != 0 && !read_some(ends[1].fd, process.err)) ends[1].fd = -1;
  }
}

}  // namespace

void add_sanitizer_options(const std::string& options) {
  for (const char* const name : {"ASAN_OPTIONS", "TSAN_OPTIONS"}) {
    const char* const there = std::getenv(name);
    ::setenv(name, (there != nullptr ? there + (":" + options) : options).c_str(), 1);
  }
}

void limit_file_size(std::uint64_t bytes) {
#if defined(__SANITIZE_THREAD__)
  std::signal(SIGXFSZ, SIG_IGN);
#endif
  struct rlimit limit = {};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = bytes;
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

Process run_noli(const std::vector<std::string>& arguments, const ProcessOptions& options) {
  Pipe out, err;
  if (options.hang_up) out.close_read();
  const pid_t child = start(arguments, options, out, err);
  out.close_write();
  err.close_write();
  std::thread sender;
  if (options.signal) sender = std::thread(send_signal, child, *options.signal, options.signal_after);
  Process process;
  read_all(out, err, process);
  if (sender.joinable()) sender.join();
  int status = 0;
  struct rusage usage = {};
  ::wait4(child, &status, 0, &usage);
  if (WIFEXITED(status)) process.exit_code = WEXITSTATUS(status);
  process.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return process;
}

nlohmann::json json_of(std::vector<std::string> arguments, int expected_exit_code) {
  arguments.insert(arguments.end(), {"--json", "-"});
  const Process process = run_noli(arguments);
  EXPECT_EQ(process.exit_code, expected_exit_code) << process.out << process.err;
  return nlohmann::json::parse(process.out);
}

std::string without_timing(nlohmann::json document) {
  EXPECT_EQ(document.erase("timing"), 1u);
  return document.dump(2);
}

std::uint64_t trials(std::uint64_t some, std::uint64_t all) {
  return std::getenv("NOLI_EVERY_FAULT") != nullptr ? all : some;
}

bool verified_checker_is_there() {
  const bool there = std::filesystem::exists(std::filesystem::path(NOLI_COMMAND).parent_path() / "noli_check_verified");
  if (!there) std::fputs("skipped: the verified checker, which is not built\n", stderr);
  return there;
}

}  // namespace noli::app_tests
