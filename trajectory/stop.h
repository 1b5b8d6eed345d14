// SPDX-License-Identifier: Apache-2.0
//
// The request to stop this process, from the user (Ctrl-C) or a time limit.
//
// A program makes the request, from a signal handler or a timer. Long work checks for it at least ten times a second,
// and throws Stopped. Checks are cheap, so inner loops may check in each iteration.
//
// Where several pieces of work go on in one process, each has a request of its own (StopOfThread).
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <noli/errors.h>

namespace noli {

namespace stop_detail {
inline std::atomic<std::uint8_t> asked{0};
inline constinit thread_local const std::atomic<bool>* of_thread = nullptr;
static_assert(std::atomic<std::uint8_t>::is_always_lock_free, "a signal handler writes it");
[[noreturn]] void throw_stopped();
}  // namespace stop_detail

/// Asks everything in this process to stop. A signal handler may call it.
inline void ask_to_stop(StopReason reason) noexcept {
  stop_detail::asked.fetch_or(static_cast<std::uint8_t>(reason), std::memory_order_relaxed);
}

/// Takes all requests back; for tests.
inline void forget_stops() noexcept { stop_detail::asked.store(0, std::memory_order_relaxed); }

/// While it exists, `stop` stops what this thread does, as Ctrl-C would: also while it waits for a pipe. Threads that
/// this one starts do not hear it. One within another takes its place.
class StopOfThread {
 public:
  explicit StopOfThread(const std::atomic<bool>& stop) noexcept : StopOfThread(&stop) {}
  /// The same; nullptr changes nothing.
  explicit StopOfThread(const std::atomic<bool>* stop) noexcept
      : outer_(std::exchange(stop_detail::of_thread, stop != nullptr ? stop : stop_detail::of_thread)) {}
  ~StopOfThread() { stop_detail::of_thread = outer_; }
  StopOfThread(const StopOfThread&) = delete;
  StopOfThread& operator=(const StopOfThread&) = delete;

 private:
  const std::atomic<bool>* outer_;
};

/// What `stop` of the innermost StopOfThread of this thread is, for threads that work on its behalf; nullptr without
/// one.
inline const std::atomic<bool>* stop_of_thread() noexcept { return stop_detail::of_thread; }

/// Whether, and why, the process or the work of this thread was asked to stop. The user comes before the time limit.
inline std::optional<StopReason> stop_asked() noexcept {
  const std::atomic<bool>* const of_thread = stop_detail::of_thread;
  if (of_thread != nullptr && of_thread->load(std::memory_order_relaxed)) return StopReason::interrupted;
  const std::uint8_t asked = stop_detail::asked.load(std::memory_order_relaxed);
  if (asked == 0) return std::nullopt;
  return (asked & static_cast<std::uint8_t>(StopReason::interrupted)) != 0 ? StopReason::interrupted
                                                                           : StopReason::out_of_time;
}

/// The requests to stop work that several threads share. Any of them may call is_asked(). The flags must outlive it.
class StopOfWork {
 public:
  /// Made by the thread that begins the work: its StopOfThread counts too. `stop`: a further flag, or nullptr.
  StopOfWork(const std::atomic<bool>* stop, std::optional<std::chrono::steady_clock::time_point> deadline) noexcept
      : stop_(stop), of_thread_(stop_of_thread()), deadline_(deadline) {}

  bool is_asked() const noexcept {
    const auto is_set = [](const std::atomic<bool>* flag) { return flag && flag->load(std::memory_order_relaxed); };
    if (stop_asked() || is_set(stop_) || is_set(of_thread_)) return true;
    return deadline_ && std::chrono::steady_clock::now() >= *deadline_;
  }

 private:
  const std::atomic<bool>*stop_, *of_thread_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

/// Throws Stopped, without a place, when the process or the work of this thread was asked to stop.
inline void end_if_stopped() {
  if (stop_asked()) stop_detail::throw_stopped();
}

/// A stop was asked for while a reader read its file or waited for it, a pipe for example. what() is one line.
class ReadInterrupted : public Stopped {
 public:
  explicit ReadInterrupted(const std::string& file)
      : ReadInterrupted(file, stop_asked().value_or(StopReason::interrupted)) {}

 private:
  ReadInterrupted(const std::string& file, StopReason reason)
      : Stopped(reason, Message{on_one_line(file + (reason == StopReason::interrupted
                                                        ? ": interrupted while it was read"
                                                        : ": the time limit has passed while it was read"))}) {}
};

}  // namespace noli
