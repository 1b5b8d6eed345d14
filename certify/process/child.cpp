// SPDX-License-Identifier: Apache-2.0
#include "certify/process/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

extern char** environ;

namespace noli {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr std::chrono::milliseconds usual_pause{50}, short_pause{2};

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

/// Appends output up to a limit, then a note.
void keep(std::string& words, std::string_view next) {
  if (words.size() > most_output) return;  // the note has been added
  words.append(next.substr(0, most_output - words.size()));
  if (words.size() == most_output) words += "\n[cut off after 1 MB]\n";
}

/// The first three descriptors are moved before the fourth, which may have the number of one of them.
pid_t start(std::vector<std::string> words, const std::array<int, 4>& given) {
  require_startable(words[0]);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int theirs = 0; theirs < 4; ++theirs) {
    const int ours = given[static_cast<std::size_t>(theirs)];
    if (ours == Child::nothing) posix_spawn_file_actions_addopen(&actions, theirs, "/dev/null", O_RDWR, 0);
    if (ours >= 0) posix_spawn_file_actions_adddup2(&actions, ours, theirs);
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

}  // namespace

std::string ProgramEnd::words() const {
  switch (kind) {
    case Kind::exited: return fmt::format("exit code {}", code);
    case Kind::signalled: return fmt::format("signal {} ({})", code, ::strsignal(code));
    case Kind::hung: return "no end within the time limit";
    case Kind::stopped: return "stopped";
  }
  return "";
}

std::string ProgramEnd::brief() const {
  switch (kind) {
    case Kind::exited: return fmt::format("exit {}", code);
    case Kind::signalled: return fmt::format("signal {}", code);
    case Kind::hung: return fmt::format("no end after {:.0f} s", seconds);
    case Kind::stopped: return "stopped";
  }
  return "";
}

std::function<bool()> stop_by(const std::atomic<bool>* flag) {
  return [flag] { return flag != nullptr && flag->load(std::memory_order_relaxed); };
}

void require_startable(const std::string& program) {
  if (::access(program.c_str(), X_OK) != 0) fail(program + " cannot be started");
}

ssize_t write_to_pipe(int descriptor, std::string_view bytes) {
  sigset_t pipe, before, pending;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  ::sigpending(&pending);  // one that is pending already is not ours
  ::pthread_sigmask(SIG_BLOCK, &pipe, &before);
  const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
  const int error = errno;
  if (written < 0 && error == EPIPE && sigismember(&pending, SIGPIPE) == 0) {
    constexpr timespec at_once{};
    while (::sigtimedwait(&pipe, nullptr, &at_once) < 0 && errno == EINTR) {
    }
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return written;
}

bool Patience::is_over() {
  const Clock::time_point now = Clock::now();
  left_ -= std::min<nanoseconds>(now - std::exchange(last_, now), std::chrono::seconds(1));
  return left_ <= nanoseconds(0);
}

void Descriptor::take(int descriptor) {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = descriptor;
}

Child::Child(std::vector<std::string> words, const Descriptors& given) {
  std::array<int, 4> passed = {given.in, given.out, given.err, given.third};
  std::array<Descriptor, 3> theirs;
  for (std::size_t i = 0; i < 3; ++i) {
    if (passed[i] != piped) continue;
    std::array<int, 2> ends;
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("a pipe");
    pipes_[i].take(ends[i == 0 ? 1 : 0]);
    theirs[i].take(ends[i == 0 ? 0 : 1]);
    if (::fcntl(pipes_[i].get(), F_SETFL, O_NONBLOCK) != 0) fail("a pipe");
    passed[i] = theirs[i].get();
  }
  pid_ = start(std::move(words), passed);
}

Child::~Child() {
  if (pid_ >= 0) end_it(std::chrono::milliseconds(0));
}

/// Reads from a pipe; returns whether there was something.
bool Child::take(std::size_t pipe) {
  std::array<char, 65536> part;
  const ssize_t got = ::read(pipes_[pipe].get(), part.data(), part.size());
  if (got > 0) keep(pipe == 1 ? out : err, {part.data(), static_cast<std::size_t>(got)});
  if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) pipes_[pipe].close();
  return got > 0;
}

void Child::look(nanoseconds pause, bool to_write) {
  std::array<pollfd, 3> ends = {
      {{to_write ? pipes_[0].get() : -1, POLLOUT, 0}, {pipes_[1].get(), POLLIN, 0}, {pipes_[2].get(), POLLIN, 0}}};
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(pause);
  const timespec time = {seconds.count(), (pause - seconds).count()};
  const int there = ::ppoll(ends.data(), ends.size(), &time, nullptr);
  if (there < 0 && errno != EINTR) fail("waiting for a program");
  for (std::size_t i = 1; i < 3 && there > 0; ++i) {
    if (ends[i].revents != 0) take(i);
  }
}

Child::Written Child::write(std::string_view bytes, const ProgramLimits& limits) {
  Patience patience(limits.time);
  while (!bytes.empty()) {
    const ssize_t written = write_to_pipe(pipes_[0].get(), bytes);
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
      patience = Patience(limits.time);
    }
    if (written >= 0 || errno == EINTR) continue;
    if (errno == EPIPE || (errno == EAGAIN && silent())) return Written::refused;
    if (errno != EAGAIN) fail("what a program is to read");
    if (limits.stop()) return Written::stopped;
    if (patience.is_over()) return Written::late;
    look(usual_pause, true);
  }
  return Written::all;
}

std::optional<std::string> Child::read(std::size_t count, const ProgramLimits& limits) {
  for (Patience patience(limits.time); out.size() < count; look(usual_pause)) {
    if (silent() || limits.stop() || patience.is_over()) return std::nullopt;
  }
  std::string bytes = out.substr(0, count);
  out.erase(0, count);
  return bytes;
}

ProgramEnd Child::finish(const ProgramLimits& limits) {
  pipes_[0].close();
  Patience patience(limits.time), stay(time_to_stay);
  while (!has_ended()) {
    if (limits.stop()) return end(ProgramEnd::Kind::stopped, limits.to_end);
    if (!silent()) stay = Patience(time_to_stay);
    if (patience.is_over() || stay.is_over()) return end(ProgramEnd::Kind::hung, limits.to_end);
    look(silent() ? short_pause : usual_pause);
  }
  return end(ProgramEnd::Kind::exited, limits.to_end);
}

bool Child::has_ended() const {
  if (pid_ < 0) return true;
  siginfo_t info = {};
  const int error = ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
  if (error != 0 && errno == ECHILD) return true;  // somebody else has waited for it
  if (error != 0 && errno != EINTR) fail("waiting for a program");
  return error == 0 && info.si_pid == pid_;
}

ProgramEnd Child::end(ProgramEnd::Kind why, std::chrono::milliseconds patience) {
  ProgramEnd result;
  result.kind = why;
  const std::optional<int> known = end_it(patience);
  if (why == ProgramEnd::Kind::exited) {
    if (!known) throw std::system_error(ECHILD, std::generic_category(), "how a program ended");
    const int status = *known;
    if (WIFSIGNALED(status)) result.kind = ProgramEnd::Kind::signalled;
    result.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  constexpr int most_parts = 64;  // a process left in its group may write forever
  for (const std::size_t pipe : {1, 2}) {
    for (int part = 0; part < most_parts && pipes_[pipe].get() >= 0 && take(pipe); ++part) {
    }
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  result.out = std::move(out);
  result.err = std::move(err);
  return result;
}

/// Its status, unless somebody else has taken it. Ends the rest of its group first, while the number of the group
/// cannot belong to another one.
std::optional<int> Child::end_it(std::chrono::milliseconds patience) {
  if (pid_ < 0) return std::nullopt;
  const auto signal = [this](int number) {
    ::kill(-pid_, number);
    ::kill(pid_, number);  // before it has a group of its own
  };
  if (patience.count() > 0 && !has_ended()) {
    signal(SIGTERM);
    for (Patience left(patience); !has_ended() && !left.is_over();) look(short_pause);
  }
  signal(SIGKILL);
  int status = 0;
  const pid_t pid = std::exchange(pid_, -1);
  while (::waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) return std::nullopt;
  }
  return status;
}

nanoseconds Child::computed() const {
  clockid_t clock = 0;
  timespec time = {};
  if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return nanoseconds(0);
  return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

std::uint64_t Child::resident_bytes() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/statm");
  std::uint64_t all = 0, resident = 0;
  if (!(file >> all >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::optional<double> Child::share_read(const std::filesystem::path& file) const {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path process = fs::path("/proc") / std::to_string(pid_);
  const std::uint64_t size = fs::file_size(file, error);
  if (error || size == 0) return std::nullopt;
  for (fs::directory_iterator at_descriptor(process / "fd", error), end; !error && at_descriptor != end;
       at_descriptor.increment(error)) {
    std::error_code gone;
    if (!fs::equivalent(at_descriptor->path(), file, gone)) continue;
    std::ifstream info(process / "fdinfo" / at_descriptor->path().filename());
    std::string word;
    std::uint64_t at = 0;
    if (info >> word >> at && word == "pos:") return std::min(1.0, static_cast<double>(at) / static_cast<double>(size));
  }
  return std::nullopt;
}

}  // namespace noli
