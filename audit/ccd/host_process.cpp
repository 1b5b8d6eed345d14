// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/host_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <noli/ccd_plugin.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/process/start_process.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

/// With the memory as its descriptor 3, a pipe for what it says of errors, and no other input or output.
pid_t start(std::vector<std::string> words, int memory, int errors) {
  constexpr int nothing = GivenDescriptor::nothing;
  return start_process(std::move(words),
                       std::array<GivenDescriptor, 4>{{{3, memory}, {0, nothing}, {1, nothing}, {2, errors}}});
}

std::vector<std::string> words(const HostOptions& options, const std::optional<fs::path>& library, bool pipeline) {
  std::vector<std::string> result = {options.host.string()};
  if (options.sandbox) result.emplace_back("--sandbox");
  if (pipeline) result.emplace_back("--frames");
  if (library) result.push_back(fs::absolute(*library).string());
  return result;
}

[[noreturn]] void throw_no_sandbox() {
  throw InputError("--sandbox", "",
                   "this machine filters no calls of the system (seccomp); expected a Linux that does");
}

double seconds(nanoseconds time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

SharedMemory::SharedMemory(std::size_t size) : size_(size), memory_(MAP_FAILED) {
  descriptor_ = ::memfd_create("noli_ccd", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  // The other process cannot cut off what this one has mapped, which would end both.
  if (descriptor_ >= 0 && ::ftruncate(descriptor_, static_cast<off_t>(size_)) == 0 &&
      ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK) == 0) {
    memory_ = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  }
  if (memory_ != MAP_FAILED) return;
  const int error = errno;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw std::system_error(error, std::generic_category(), "shared memory");
}

SharedMemory::~SharedMemory() {
  ::munmap(memory_, size_);
  ::close(descriptor_);
}

std::size_t SharedMemory::bytes_behind(std::size_t offset) const {
  struct stat status = {};
  if (::fstat(descriptor_, &status) != 0) return 0;
  const auto size = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
  return size - std::min(size, offset);
}

bool SharedMemory::read(std::size_t offset, std::span<std::byte> target) const {
  while (!target.empty()) {
    const ssize_t got = ::pread(descriptor_, target.data(), target.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    offset += static_cast<std::size_t>(got);
    target = target.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

HostProcess::HostProcess(const std::optional<fs::path>& library, const SharedMemory& memory, const HostStatus& status,
                         const HostOptions& options, bool pipeline)
    : options_(options),
      status_(status),
      pid_(start(words(options, library, pipeline), memory.descriptor(), said_.end(1))) {
  said_.close(1);
  said_.never_wait(0);
}

/// Keeps the end of what was said so far.
void HostProcess::listen() {
  std::array<char, 4096> part;
  for (int parts = 0; parts < 64; ++parts) {
    const ssize_t got = ::read(said_.end(0), part.data(), part.size());
    if (got <= 0) return;
    end_of_said_.append(part.data(), static_cast<std::size_t>(got));
    if (end_of_said_.size() > 2 * most_said) end_of_said_.erase(0, end_of_said_.size() - most_said);
  }
}

Ending HostProcess::wait() {
  Ending ending = wait_for_end();
  listen();
  if (end_of_said_.size() > most_said) end_of_said_.erase(0, end_of_said_.size() - most_said);
  ending.said = std::move(end_of_said_);
  return ending;
}

Ending HostProcess::wait_for_end() {
  nanoseconds pause = std::chrono::microseconds(100);
  begin_call();
  for (;;) {
    listen();
    if (const auto status = ended()) return ending(*status);
    if (stopped()) return ended_by_us(Ending::Kind::stopped, "stopped");
    if (hangs())
      return ended_by_us(Ending::Kind::hung, fmt::format("no answer within its limit of {:g} s", seconds(limit())));
    if (resident_bytes() > options_.most_memory) {
      return ended_by_us(Ending::Kind::too_much_memory, fmt::format("more than {} bytes", options_.most_memory));
    }
    std::this_thread::sleep_for(pause);
    pause = std::min<nanoseconds>(2 * pause, std::chrono::milliseconds(5));
  }
}

bool HostProcess::stopped() const {
  if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed)) return true;
  return options_.deadline && Clock::now() >= *options_.deadline;
}

/// What the library has started ends with it: its group is ended before its number can be another's.
std::optional<int> HostProcess::ended() {
  if (!has_ended(pid_)) return std::nullopt;
  return end_process(std::exchange(pid_, -1), std::chrono::milliseconds(0));
}

Ending HostProcess::ending(int status) const {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return {Ending::Kind::crashed, fmt::format("signal {} ({})", signal, ::strsignal(signal))};
  }
  if (options_.sandbox && WEXITSTATUS(status) == no_sandbox) throw_no_sandbox();
  const bool done = status_.phase.load(std::memory_order_acquire) == HostPhase::done;
  if (done && WEXITSTATUS(status) == 0) return {};
  return {Ending::Kind::crashed, fmt::format("it ended the program, with code {}", WEXITSTATUS(status))};
}

Ending HostProcess::ended_by_us(Ending::Kind kind, const std::string& words) {
  end_it();
  return {kind, words};
}

void HostProcess::end_it() {
  if (pid_ >= 0) end_process(std::exchange(pid_, -1), std::chrono::milliseconds(0));
}

/// What the process has computed so far, all its threads together.
nanoseconds HostProcess::computed() const {
  clockid_t clock = 0;
  struct timespec time = {};
  if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return nanoseconds(0);
  return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

void HostProcess::begin_call() {
  calls_ = status_.calls.load(std::memory_order_relaxed);
  begin_ = Clock::now();
  computed_ = computed();
}

nanoseconds HostProcess::limit() const {
  const HostPhase phase = status_.phase.load(std::memory_order_relaxed);
  if (phase == HostPhase::searching) return options_.search_limit * options_.query_limit;
  if (phase == HostPhase::loading) return std::max<nanoseconds>(options_.query_limit, std::chrono::seconds(3));
  return options_.query_limit;
}

/// On a busy machine a process may not run for long: what counts is what it computes, or ten times the limit.
bool HostProcess::hangs() {
  if (status_.calls.load(std::memory_order_relaxed) != calls_) {
    begin_call();
    return false;
  }
  return waited() >= limit() && (computed() - computed_ >= limit() || waited() >= 10 * limit());
}

std::uint64_t HostProcess::resident_bytes() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/statm");
  std::uint64_t all = 0, resident = 0;
  if (!(file >> all >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

template <std::size_t Size>
std::string text_of(const std::array<char, Size>& text) {
  return {text.data(), ::strnlen(text.data(), text.size())};
}

void require_loaded(const std::optional<fs::path>& library, const HostStatus& status, const Ending& ending) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(library ? library->string() : "textbook", "", problem);
  };
  if (ending.kind == Ending::Kind::stopped) return;
  if (ending.kind != Ending::Kind::finished) {
    if (status.phase.load() == HostPhase::loading) refuse("cannot be loaded: " + ending.words + " meanwhile");
    return;
  }
  const auto lacks = [&](const char* function) {
    refuse(fmt::format("has no function {} (include/noli/ccd_plugin.h)", function));
  };
  switch (status.loaded) {
    case LoadResult::ok: return;
    case LoadResult::not_loaded: refuse(fmt::format("cannot be loaded: {}", text_of(status.message))); break;
    case LoadResult::no_version: lacks("noli_ccd_version"); break;
    case LoadResult::no_query: lacks("noli_ccd_query"); break;
    case LoadResult::no_candidates: lacks("noli_ccd_candidates"); break;
    case LoadResult::other_version:
      refuse(fmt::format("is for version {} of the interface; expected {}", status.version, NOLI_CCD_VERSION));
  }
}

}  // namespace noli::audit
