// SPDX-License-Identifier: Apache-2.0
#include "certify/process/run_program.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <utility>

#include "certify/process/pipe.h"
#include "certify/process/start_process.h"

namespace noli {

namespace {

using Clock = std::chrono::steady_clock;

/// How long a program was waited for, by the clock on the wall. A time in which this process did not look counts as a
/// second at most: it was stopped itself, or the machine slept.
class Patience {
 public:
  explicit Patience(std::chrono::nanoseconds limit) : left_(limit) {}

  bool is_over() {
    const Clock::time_point now = Clock::now();
    left_ -= std::min<std::chrono::nanoseconds>(now - std::exchange(last_, now), std::chrono::seconds(1));
    return left_ <= std::chrono::nanoseconds(0);
  }

 private:
  std::chrono::nanoseconds left_;
  Clock::time_point last_ = Clock::now();
};

/// A program at work, ended with this.
class Running {
 public:
  explicit Running(std::vector<std::string> words) {
    pid_ = start_process(std::move(words), std::array<GivenDescriptor, 3>{{{STDIN_FILENO, GivenDescriptor::nothing},
                                                                           {STDOUT_FILENO, out_.end(1)},
                                                                           {STDERR_FILENO, err_.end(1)}}});
    out_.close(1);
    err_.close(1);
  }
  ~Running() { end_it(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// Reads until it has closed both, or a limit is reached.
  void read(const ProgramLimits& limits, ProgramEnd& end) {
    Patience patience(limits.time);
    while (out_.end(0) >= 0 || err_.end(0) >= 0) {
      if (limits.stop && limits.stop->load(std::memory_order_relaxed)) return give_up(end, ProgramEnd::Kind::stopped);
      if (patience.is_over()) return give_up(end, ProgramEnd::Kind::hung);
      constexpr int milliseconds = 50;
      std::array<pollfd, 2> ends = {{{out_.end(0), POLLIN, 0}, {err_.end(0), POLLIN, 0}}};
      if (::poll(ends.data(), ends.size(), milliseconds) <= 0) continue;
      if (ends[0].revents != 0) take(out_, end.out);
      if (ends[1].revents != 0) take(err_, end.err);
    }
    const auto stopped = [&] { return limits.stop && limits.stop->load(std::memory_order_relaxed); };
    const std::optional<int> status = wait_for_end(pid_, time_to_stay, [&] { return stopped() || patience.is_over(); });
    if (!status) return give_up(end, stopped() ? ProgramEnd::Kind::stopped : ProgramEnd::Kind::hung);
    pid_ = -1;
    end.kind = WIFSIGNALED(*status) ? ProgramEnd::Kind::signalled : ProgramEnd::Kind::exited;
    end.code = WIFSIGNALED(*status) ? WTERMSIG(*status) : WEXITSTATUS(*status);
  }

 private:
  static void take(Pipe& pipe, std::string& text) {
    std::array<char, 65536> part;
    const ssize_t got = ::read(pipe.end(0), part.data(), part.size());
    if (got > 0) take_words(text, {part.data(), static_cast<std::size_t>(got)});
    if (got == 0 || (got < 0 && errno != EINTR)) pipe.close(0);
  }

  void give_up(ProgramEnd& end, ProgramEnd::Kind kind) {
    end_it();
    end.kind = kind;
  }

  void end_it() {
    if (pid_ >= 0) end_process(std::exchange(pid_, -1), time_to_end);
  }

  Pipe out_, err_;
  pid_t pid_ = -1;
};

/// Whether a shell reads the word as it stands.
bool plain(const std::string& word) {
  constexpr std::string_view harmless = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+=,:@%";
  return !word.empty() && word.find_first_not_of(harmless) == std::string::npos;
}

std::string quoted(const std::string& word) {
  if (plain(word)) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

std::string ProgramEnd::words() const {
  switch (kind) {
    case Kind::exited: return fmt::format("exit code {}", code);
    case Kind::signalled: return fmt::format("signal {} ({})", code, ::strsignal(code));
    case Kind::hung: return "no end within its limit of time";
    case Kind::stopped: return "stopped";
  }
  return "";
}

ProgramEnd run_program(std::vector<std::string> words, const ProgramLimits& limits) {
  ProgramEnd end;
  Running(std::move(words)).read(limits, end);
  return end;
}

std::string shell_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

}  // namespace noli
