// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/host_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <noli/ccd_plugin.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/process/run_program.h"
#include "trajectory/text.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

std::vector<std::string> words(const HostOptions& options, const std::optional<fs::path>& library, bool pipeline) {
  std::vector<std::string> result = {options.host.string()};
  if (options.sandbox) result.emplace_back("--sandbox");
  if (pipeline) result.emplace_back("--frames");
  if (library) result.push_back(fs::absolute(*library).string());
  return result;
}

/// Asked without a library, which could end with the same code.
bool has_sandbox(const fs::path& host) {
  ProgramLimits limits;
  limits.time = std::chrono::seconds(10);
  return run_program({host.string(), "--sandbox", "--probe"}, limits).exited_with(0);
}

[[noreturn]] void throw_no_sandbox() {
  throw InputError("--sandbox", "", "this machine cannot filter system calls (seccomp); expected a Linux that can");
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
      child_(words(options, library, pipeline), {.err = Child::piped, .third = memory.descriptor()}) {}

Ending HostProcess::wait() {
  nanoseconds pause = std::chrono::microseconds(100);
  begin_call();
  for (;;) {
    // What the library says may be endless: only the end of it is kept.
    if (child_.err.size() > 2 * most_said) child_.err.erase(0, child_.err.size() - most_said);
    if (child_.has_ended()) return ending();
    if (options_.over()) return ended_by_us(Ending::Kind::stopped, "stopped");
    if (hangs())
      return ended_by_us(Ending::Kind::hung, fmt::format("no answer within the limit of {:g} s", seconds(limit())));
    if (child_.resident_bytes() > options_.most_memory) {
      return ended_by_us(Ending::Kind::too_much_memory, fmt::format("more than {} bytes", options_.most_memory));
    }
    child_.look(pause);
    pause = std::min<nanoseconds>(2 * pause, std::chrono::milliseconds(5));
  }
}

std::string HostProcess::said(ProgramEnd& end) {
  if (end.err.size() > most_said) end.err.erase(0, end.err.size() - most_said);
  return std::move(end.err);
}

Ending HostProcess::ending() {
  ProgramEnd end = child_.end(ProgramEnd::Kind::exited, {});
  if (end.kind == ProgramEnd::Kind::signalled) return {Ending::Kind::crashed, end.words(), said(end)};
  if (options_.sandbox && end.code == no_sandbox && !has_sandbox(options_.host)) throw_no_sandbox();
  const bool done = status_.phase.load(std::memory_order_acquire) == HostPhase::done;
  if (done && end.code == 0) return {Ending::Kind::finished, "", said(end)};
  return {Ending::Kind::crashed, fmt::format("it ended the program, with code {}", end.code), said(end)};
}

Ending HostProcess::ended_by_us(Ending::Kind kind, const std::string& words) {
  ProgramEnd end = child_.end(ProgramEnd::Kind::stopped, {});
  return {kind, words, said(end)};
}

void HostProcess::begin_call() {
  calls_ = status_.calls.load(std::memory_order_relaxed);
  begin_ = Clock::now();
  computed_ = child_.computed();
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
  const nanoseconds waited = Clock::now() - begin_;
  return waited >= limit() && (child_.computed() - computed_ >= limit() || waited >= 10 * limit());
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
    const std::string said = on_one_line(first_line(ending.said));
    const std::string why = said.empty() ? "" : fmt::format("; its standard error begins with: {}", said);
    if (status.phase.load() == HostPhase::loading) refuse("cannot be loaded: " + ending.words + " while loading" + why);
    return;
  }
  const auto lacks = [&](const char* function) {
    refuse(fmt::format("has no visible function {} (include/noli/ccd_plugin.h; C++ needs extern \"C\")", function));
  };
  switch (status.loaded) {
    case LoadResult::ok: return;
    case LoadResult::not_loaded: refuse(fmt::format("cannot be loaded: {}", text_of(status.message))); break;
    case LoadResult::no_version: lacks("noli_ccd_version"); break;
    case LoadResult::no_query: lacks("noli_ccd_query"); break;
    case LoadResult::no_candidates: lacks("noli_ccd_candidates"); break;
    case LoadResult::other_version:
      refuse(fmt::format("is for version {} of the interface; expected {}: compile it with include/noli/ccd_plugin.h",
                         status.version, NOLI_CCD_VERSION));
  }
}

}  // namespace noli::audit
