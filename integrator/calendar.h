// SPDX-License-Identifier: Apache-2.0
//
// A calendar queue (Brown 1988, "Calendar queues: a fast O(1) priority queue implementation") for events that come back
// at fixed steps: every force with a clock of its own.
//
// Notation
//   event     a number; all events are in the queue all the time, each at its clock's time
//   day       a stretch of time not longer than half the least step, so that an event never comes back on the day on
//             which it happens; day d holds the times t with floor(t / length) = d
//   calendar  as many days as the longest step needs, used in turn; or so many that an event may have to wait for
//             another year, in which a page is used again
//   hour      a day has as many as it has events; they sort its events nearly
//
// Events come in ascending order of (time, number). Entries carry their clocks: looking into a table of events, in the
// order in which they happen, would cost a cache miss each. Days are long, so that few of them are written to by turns
// and stay in the cache.
//
// What this does not do: events that come or go.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "integrator/clocks.h"

namespace noli::integrator {

class Calendar {
 public:
  struct Entry {
    double step, next;  ///< h and k, a whole number
    std::uint32_t event;
    std::uint32_t kind;  ///< what the caller says of it

    double time() const { return next * step; }
  };

  Calendar() = default;

  /// One event for each step; each at its first time after `now`. `kinds`: one for each step. Precondition: steps
  /// positive, fewer than 2^32.
  Calendar(const std::vector<double>& steps, const std::vector<std::uint32_t>& kinds, double now) {
    if (steps.empty()) return;
    const auto [least, longest] = std::minmax_element(steps.begin(), steps.end());
    double rate = 0;
    for (const double h : steps) rate += 1 / h;
    length_ = std::min(0.5 * *least, per_day / rate);
    const double days = *longest / length_ + 3;
    many_years_ = days > most_days;
    days_.resize(std::bit_ceil(static_cast<std::size_t>(std::min(days, most_days))));
    for (std::size_t i = 0; i < steps.size(); ++i) {
      put({steps[i], static_cast<double>(first_after(now, steps[i])), static_cast<std::uint32_t>(i), kinds[i]});
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
    put({entry.step, entry.next + 1, entry.event, entry.kind});
    if (++at_ == today_.size()) {
      ++day_;
      open();
    }
  }

 private:
  static constexpr double per_day = 1024;       ///< events that are sorted at once
  static constexpr double most_days = 1 << 16;  ///< in a year

  static bool before(const Entry& a, const Entry& b) {
    return a.time() != b.time() ? a.time() < b.time() : a.event < b.event;
  }

  /// Their number is a power of two.
  std::vector<Entry>& page(std::uint64_t day) { return days_[day & (days_.size() - 1)]; }

  std::uint64_t day_of(const Entry& entry) const { return static_cast<std::uint64_t>(entry.time() / length_); }

  void put(const Entry& entry) { page(day_of(entry)).push_back(entry); }

  /// Turns to the next day on which something happens.
  void open() {
    for (today_.clear(); today_.empty(); ++day_) take(page(day_));
    --day_;
    sort_nearly_sorted();
    at_ = 0;
  }

  void take(std::vector<Entry>& entries) {
    if (entries.empty()) return;
    if (!many_years_) {
      sort_by_hours(entries);
      return entries.clear();
    }
    const auto later =
        std::stable_partition(entries.begin(), entries.end(), [this](const Entry& e) { return day_of(e) == day_; });
    sort_by_hours({entries.begin(), later});
    entries.erase(entries.begin(), later);
  }

  /// Into today_. Counting instead of comparing: a comparison of random times is a branch that no processor foresees.
  void sort_by_hours(std::span<const Entry> entries) {
    const std::size_t n = entries.size();
    const double begin = static_cast<double>(day_) * length_, hours_a_second = static_cast<double>(n) / length_;
    hours_.resize(n);
    begins_.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const auto hour = static_cast<std::int64_t>((entries[i].time() - begin) * hours_a_second);
      hours_[i] = static_cast<std::uint32_t>(std::clamp<std::int64_t>(hour, 0, static_cast<std::int64_t>(n) - 1));
      ++begins_[hours_[i] + 1];
    }
    for (std::size_t i = 1; i < n; ++i) begins_[i] += begins_[i - 1];
    today_.resize(n);
    for (std::size_t i = 0; i < n; ++i) today_[begins_[hours_[i]]++] = entries[i];
  }

  void sort_nearly_sorted() {
    for (std::size_t i = 1; i < today_.size(); ++i) {
      if (!before(today_[i], today_[i - 1])) continue;
      const Entry entry = today_[i];
      std::size_t j = i;
      for (; j > 0 && before(entry, today_[j - 1]); --j) today_[j] = today_[j - 1];
      today_[j] = entry;
    }
  }

  std::vector<std::vector<Entry>> days_;
  double length_ = 0;
  std::uint64_t day_ = 0;
  std::vector<Entry> today_;                   ///< sorted
  std::vector<std::uint32_t> hours_, begins_;  ///< for sort_by_hours; mean nothing between
  std::size_t at_ = 0;
  bool many_years_ = false;
};

}  // namespace noli::integrator
