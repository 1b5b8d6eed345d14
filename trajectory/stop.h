// SPDX-License-Identifier: Apache-2.0
//
// The one request to stop of a process: the user's (Ctrl-C) or that of a time limit.
//
// A program makes the request, from a signal handler or a timer. Whatever takes long asks for it, at least ten times a
// second, and throws Stopped. Asking costs one load, so inner loops may ask at each turn.
//
// What this does not do: it ends nothing by itself, and a library that nobody asks to stop never stops.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace noli {

enum class StopReason : std::uint8_t { interrupted = 1, out_of_time = 2 };

/// Work ended before its end, because the process was asked to stop. what() is one line: "PLACE: interrupted", or
/// "PLACE: the time limit has passed".
class Stopped : public std::runtime_error {
 public:
  /// `place`: what was being done, or read; may be empty.
  Stopped(StopReason reason, const std::string& place);
  StopReason reason() const { return reason_; }

 protected:
  struct Words {
    std::string all;
  };
  Stopped(StopReason reason, const Words& words) : std::runtime_error(words.all), reason_(reason) {}

 private:
  StopReason reason_;
};

namespace stop_detail {
inline std::atomic<std::uint8_t> asked{0};
static_assert(std::atomic<std::uint8_t>::is_always_lock_free, "a signal handler writes it");
[[noreturn]] void throw_stopped();
}  // namespace stop_detail

/// Asks everything in this process to stop. A signal handler may call it.
inline void ask_to_stop(StopReason reason) noexcept {
  stop_detail::asked.fetch_or(static_cast<std::uint8_t>(reason), std::memory_order_relaxed);
}

/// Takes all requests back: for tests.
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

}  // namespace noli
