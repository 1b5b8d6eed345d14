// SPDX-License-Identifier: Apache-2.0
//
// The request to stop this process, from the user (Ctrl-C) or a time limit.
//
// A program makes the request, from a signal handler or a timer. Long work checks for it at least ten times a second,
// and throws Stopped. A check costs one load, so inner loops may check in each iteration.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include <noli/errors.h>

namespace noli {

namespace stop_detail {
inline std::atomic<std::uint8_t> asked{0};
static_assert(std::atomic<std::uint8_t>::is_always_lock_free, "a signal handler writes it");
[[noreturn]] void throw_stopped();
}  // namespace stop_detail

/// Asks everything in this process to stop. A signal handler may call it.
inline void ask_to_stop(StopReason reason) noexcept {
  stop_detail::asked.fetch_or(static_cast<std::uint8_t>(reason), std::memory_order_relaxed);
}

/// Takes all requests back; for tests.
inline void forget_stops() noexcept { stop_detail::asked.store(0, std::memory_order_relaxed); }

/// Whether, and why, the process was asked to stop. The user comes before the time limit.
inline std::optional<StopReason> stop_asked() noexcept {
  const std::uint8_t asked = stop_detail::asked.load(std::memory_order_relaxed);
  if (asked == 0) return std::nullopt;
  return (asked & static_cast<std::uint8_t>(StopReason::interrupted)) != 0 ? StopReason::interrupted
                                                                           : StopReason::out_of_time;
}

/// Throws Stopped, without a place, when the process was asked to stop.
inline void end_if_stopped() {
  if (stop_detail::asked.load(std::memory_order_relaxed) != 0) stop_detail::throw_stopped();
}

/// The process was asked to stop while a reader read its file or waited for it, a pipe for example. what() is one line.
class ReadInterrupted : public Stopped {
 public:
  explicit ReadInterrupted(const std::string& file)
      : ReadInterrupted(file, stop_asked().value_or(StopReason::interrupted)) {}

 private:
  ReadInterrupted(const std::string& file, StopReason reason)
      : Stopped(reason, Words{on_one_line(file + (reason == StopReason::interrupted
                                                      ? ": interrupted while it was read"
                                                      : ": the time limit has passed while it was read"))}) {}
};

}  // namespace noli
