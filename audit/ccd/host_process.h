// SPDX-License-Identifier: Apache-2.0
//
// The process in which somebody else's library runs (audit/ccd/host/main.cpp), started and watched.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "audit/ccd/host/exchange.h"
#include "audit/ccd/host/sandbox.h"
#include "certify/process/child.h"

namespace noli::audit {

using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// How libraries are run.
struct HostOptions {
  std::filesystem::path host;              ///< the program noli_ccd_host
  std::chrono::nanoseconds query_limit{};  ///< a call that has computed for so long, or waited ten times as long, hangs
  double repeat_seconds = 0.2;             ///< about how long all queries are asked again
  std::uint64_t most_memory = 2'000'000'000;  ///< resident bytes of the process
  std::uint64_t most_hangs = 10;              ///< then the rest is not asked
  bool sandbox = false;                       ///< the library may not touch other processes and files (host/sandbox.h)
  bool in_process = false;                    ///< queries are asked in this process, for a debugger or a sanitizer
  int search_limit = 600;                     ///< a search for candidates may take so many times as long as a query
  const std::atomic<bool>* stop = nullptr;
  Deadline deadline;

  bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
  bool over() const { return stopped() || (deadline && std::chrono::steady_clock::now() >= *deadline); }
};

/// Memory that two processes share, all zero at first. Throws std::system_error when the machine has none left.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t size);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  void* begin() const { return memory_; }
  /// How many bytes there are behind an offset, with those that the other process has added.
  std::size_t bytes_behind(std::size_t offset) const;
  /// Copies what is there. False if there is less: the other process may cut it off at any time.
  bool read(std::size_t offset, std::span<std::byte> target) const;
  int descriptor() const { return descriptor_; }

 private:
  std::size_t size_;
  int descriptor_ = -1;
  void* memory_;
};

/// How a process came to its end.
struct Ending {
  enum class Kind { finished, crashed, hung, too_much_memory, stopped } kind = Kind::finished;
  std::string words;      ///< "signal 11 (Segmentation fault)"
  std::string said = {};  ///< the end of what the library wrote to its standard error, at most most_said bytes
};

constexpr std::size_t most_said = 64 << 10;

/// A host at work. Ended with the object.
class HostProcess {
 public:
  /// `memory` begins with `status`. Without a library: the textbook method. Throws std::runtime_error when the host is
  /// not there, std::system_error when the machine has no process left.
  HostProcess(const std::optional<std::filesystem::path>& library, const SharedMemory& memory, const HostStatus& status,
              const HostOptions& options, bool pipeline);
  /// Waits, and ends it when it hangs, takes too much memory, or when `options` say so. Throws InputError when there is
  /// no sandbox, though `options` ask for one.
  Ending wait();

 private:
  bool hangs();
  void begin_call();
  std::chrono::nanoseconds limit() const;
  static std::string said(ProgramEnd& end);
  Ending ending();
  Ending ended_by_us(Ending::Kind kind, const std::string& words);

  const HostOptions& options_;
  const HostStatus& status_;
  Child child_;
  std::uint64_t calls_ = 0;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::nanoseconds computed_{0};
};

/// Throws InputError if the library could not be loaded, or has not what it has to have.
void require_loaded(const std::optional<std::filesystem::path>& library, const HostStatus& status,
                    const Ending& ending);

}  // namespace noli::audit
