// SPDX-License-Identifier: Apache-2.0
//
// A calendar queue (Brown 1988, "Calendar queues: a fast O(1) priority queue implementation") for events that come back
// at fixed steps: every force with a clock of its own.
//
// Notation
//   event     a number; all events are in the queue all the time, each at its clock's time
//   day       a stretch of time not longer than half the least step, so that an event never comes back on the day on
//             which it happens; day d holds the times t with floor(t / length) = d
//   calendar  as many days as the longest step needs, used in turn
//
// Events come in ascending order of (time, number). Entries carry their clocks: looking into a table of events, in the
// order in which they happen, would cost a cache miss each.
//
// What this does not do: events that come or go.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "noli/integrator/clocks.h"

namespace noli::integrator {

class Calendar {
 public:
  struct Entry {
    Clock clock;
    double time;
    std::uint32_t event;
  };

  Calendar() = default;

  /// One event for each step; each at its first time after `now`. Precondition: steps positive, fewer than 2^32.
  Calendar(const std::vector<double>& steps, double now) {
    if (steps.empty()) return;
    const auto [least, longest] = std::minmax_element(steps.begin(), steps.end());
    double rate = 0;
    for (const double h : steps) rate += 1 / h;
    length_ = std::min(0.5 * *least, per_day / rate);
    days_.resize(static_cast<std::size_t>(*longest / length_) + 3);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      put({steps[i], first_after(now, steps[i])}, static_cast<std::uint32_t>(i));
    }
    day_ = static_cast<std::uint64_t>(now / length_);
    open();
  }

  bool empty() const { return days_.empty(); }

  /// The next event. Precondition: not empty.
  const Entry& front() const { return today_[at_]; }

  /// What comes after it on the same day, as far as it goes.
  std::size_t ahead() const { return today_.size() - at_ - 1; }
  const Entry& ahead(std::size_t i) const { return today_[at_ + i]; }

  /// Sends the next event to its next time.
  void advance() {
    const Entry& entry = today_[at_];
    put({entry.clock.step, entry.clock.next + 1}, entry.event);
    if (++at_ == today_.size()) {
      ++day_;
      open();
    }
  }

 private:
  static constexpr double per_day = 48;  ///< events that are sorted at once

  std::size_t page(std::uint64_t day) const { return static_cast<std::size_t>(day % days_.size()); }

  void put(Clock clock, std::uint32_t event) {
    const double time = clock.time();
    days_[page(static_cast<std::uint64_t>(time / length_))].push_back({clock, time, event});
  }

  /// Turns to the next day on which something happens.
  void open() {
    while (days_[page(day_)].empty()) ++day_;
    today_.clear();
    today_.swap(days_[page(day_)]);
    at_ = 0;
    std::sort(today_.begin(), today_.end(),
              [](const Entry& a, const Entry& b) { return a.time != b.time ? a.time < b.time : a.event < b.event; });
  }

  std::vector<std::vector<Entry>> days_;
  double length_ = 0;
  std::uint64_t day_ = 0;
  std::vector<Entry> today_;
  std::size_t at_ = 0;
};

}  // namespace noli::integrator
