// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/run_command.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <optional>
#include <system_error>
#include <thread>

#include "certify/process/start_process.h"

namespace noli::audit {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// A file without a name: a program can write to it as much as it likes without anybody reading.
class Buffer {
 public:
  Buffer() : descriptor_(::memfd_create("noli_output", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail("memory for a program's output");
  }
  ~Buffer() { ::close(descriptor_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  int descriptor() const { return descriptor_; }

  std::string text() const {
    std::string all;
    std::array<char, 65536> part;
    while (all.size() <= most_words) {
      const ssize_t got = ::pread(descriptor_, part.data(), part.size(), static_cast<off_t>(all.size()));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail("a program's output");
      if (got == 0) break;
      take_words(all, {part.data(), static_cast<std::size_t>(got)});
    }
    return all;
  }

 private:
  int descriptor_;
};

std::optional<int> status_of(pid_t pid, int options) {
  int status = 0;
  for (;;) {
    const pid_t ended = ::waitpid(pid, &status, options);
    if (ended == pid) return status;
    if (ended == 0) return std::nullopt;
    if (errno != EINTR) fail("waiting for a program");
  }
}

/// Waits, looking ever less often, at least fifty times a second.
void wait_for(pid_t pid, std::chrono::nanoseconds limit, const std::atomic<bool>* stop, CommandRun& run) {
  const Clock::time_point begin = Clock::now();
  std::chrono::nanoseconds pause = std::chrono::microseconds(200);
  for (;;) {
    const auto status = status_of(pid, WNOHANG);
    run.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (status) {
      run.end = WIFSIGNALED(*status) ? CommandRun::End::signalled : CommandRun::End::exited;
      run.code = WIFSIGNALED(*status) ? WTERMSIG(*status) : WEXITSTATUS(*status);
      return;
    }
    const bool asked = stop != nullptr && stop->load(std::memory_order_relaxed);
    if (asked || Clock::now() - begin >= limit) {
      end_process(pid, 2 * time_to_end);  // it may have programs of its own, which have that time
      run.end = asked ? CommandRun::End::stopped : CommandRun::End::hung;
      return;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min<std::chrono::nanoseconds>(2 * pause, std::chrono::milliseconds(20));
  }
}

}  // namespace

std::string end_words(const CommandRun& run) {
  switch (run.end) {
    case CommandRun::End::exited: return fmt::format("exit {}", run.code);
    case CommandRun::End::signalled: return fmt::format("signal {}", run.code);
    case CommandRun::End::hung: return fmt::format("no end after {:.0f} s", run.seconds);
    case CommandRun::End::stopped: return "stopped";
  }
  return "";
}

CommandRun run_command(const std::vector<std::string>& words, std::chrono::nanoseconds limit,
                       const std::atomic<bool>* stop) {
  const Buffer out, err;
  const std::array<GivenDescriptor, 3> descriptors = {
      {{STDIN_FILENO, GivenDescriptor::nothing}, {STDOUT_FILENO, out.descriptor()}, {STDERR_FILENO, err.descriptor()}}};
  CommandRun run;
  wait_for(start_process(words, descriptors), limit, stop, run);
  run.out = out.text();
  run.err = err.text();
  return run;
}

}  // namespace noli::audit
