// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/series_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "certify/process/start_process.h"
#include "certify/process/this_program.h"
#include "trajectory/text.h"

namespace noli {
namespace {

constexpr std::size_t most_child_words = 4096;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

std::string how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("noli_series ended with code {}", WEXITSTATUS(status));
  return fmt::format("noli_series was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
}

}  // namespace

bool SeriesProgram::available() const { return ::access(file.c_str(), X_OK) == 0; }

SeriesProgram series_program() {
  SeriesProgram program;
  program.file = beside_this_program("noli_series");
  return program;
}

SeriesProcess::SeriesProcess(SeriesProgram program, int output) : program_(std::move(program)) {
  in_.never_wait(1);
  err_.never_wait(0);
  pid_ = start_process({program_.file.string(), "write"},
                       std::array<GivenDescriptor, 3>{
                           {{STDIN_FILENO, in_.end(0)}, {STDOUT_FILENO, output}, {STDERR_FILENO, err_.end(1)}}});
  in_.close(0);
  err_.close(1);
}

SeriesProcess::~SeriesProcess() {
  if (pid_ >= 0) end_process(std::exchange(pid_, -1), std::chrono::milliseconds(0));
}

void SeriesProcess::take_words() {
  std::array<char, most_child_words> part;
  const ssize_t got = ::read(err_.end(0), part.data(), part.size());
  if (got > 0) words_.append(part.data(), std::min(static_cast<std::size_t>(got), most_child_words - words_.size()));
  if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) err_.close(0);
}

/// Until it takes more (POLLOUT), or has closed its standard error (0). False when it has ended before.
bool SeriesProcess::wait_for(short events) {
  constexpr int milliseconds = 100;
  const auto deadline = std::chrono::steady_clock::now() + program_.patience;
  while (err_.end(0) >= 0) {
    if (program_.stop()) throw SeriesStopped();
    if (std::chrono::steady_clock::now() >= deadline) {
      throw SeriesLost(fmt::format("noli_series took nothing for {} s", program_.patience.count() / 1000));
    }
    std::array<pollfd, 2> ends = {{{err_.end(0), POLLIN, 0}, {in_.end(1), events, 0}}};
    const int there = ::poll(ends.data(), ends.size(), milliseconds);
    if (there < 0 && errno != EINTR) fail("waiting for noli_series");
    if (there <= 0) continue;
    if (ends[0].revents != 0) take_words();
    if (ends[1].revents != 0) return true;  // or it takes no more, which write() finds out
  }
  return false;
}

int SeriesProcess::wait() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0) {
    if (errno != EINTR) fail("waiting for noli_series");
  }
  pid_ = -1;
  return status;
}

void SeriesProcess::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(in_.end(1), bytes.data(), bytes.size());
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    if (written >= 0 || errno == EINTR) continue;
    if (errno == EPIPE) conclude();
    if (errno != EAGAIN) fail("the series on their way to noli_series");
    if (!wait_for(POLLOUT)) conclude();
  }
}

/// It takes no more.
void SeriesProcess::conclude() {
  finish();
  throw SeriesLost("noli_series ended before all was written");
}

void SeriesProcess::finish() {
  in_.close(1);
  wait_for(0);
  const int status = wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw SeriesLost(WIFSIGNALED(status) || words_.empty() ? how_it_ended(status) : first_line(words_));
}

}  // namespace noli
