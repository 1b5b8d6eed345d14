// SPDX-License-Identifier: Apache-2.0
//
// Schedules forces that each have a clock of their own. They fire in rows; no two forces of a row have a vertex in
// common, so they may fire together.
//
// Notation
//   number   of a force among all forces: those of one kind follow one another
//   table    the forces of one kind
//   row      the next forces, in the order of Calendar, as long as they have no vertex in common
//
// Processors cannot predict the order of such forces. So their addresses are computed without a branch on their kind,
// and prefetched some time before they are needed.
//
// Precondition: forces do not move in memory.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "integrator/clocks.h"
#include "integrator/force.h"
#include "integrator/kick.h"

namespace noli::integrator {

/// A calendar queue (Brown 1988, "Calendar queues: a fast O(1) priority queue implementation") for events that repeat
/// at fixed steps.
///   event     a number; all events are always in the queue, each at its clock's time
///   day       a time interval not longer than half the least step, so that an event never repeats on the same day; day
///             d has the times t with floor(t / length) = d
///   calendar  pages for as many days as the longest step needs, used cyclically; or a maximum number, so that an event
///             may have to wait for another year, when its page is used again
///   bucket    a day has as many as it has events; they sort its events approximately
///
/// Events come in ascending order of (time, number). Entries contain their clocks, as a look into a table of events
/// would cost a cache miss for each. Days are long, so that writes alternate between few of them, which stay in the
/// cache. Events are never added or removed.
class Calendar {
 public:
  /// Data of an event, from the caller.
  struct EventData {
    std::uint16_t kind;
    std::uint16_t carries;  ///< bit k: gravity acts on vertex k with it
  };

  struct Entry {
    double step, next;  ///< h and k, an integer
    std::uint32_t event;
    EventData data;

    double time() const { return next * step; }
  };

  Calendar() = default;

  /// One event for each step, at its first time after `now`. `data`: one for each step. Precondition: steps are
  /// positive, and fewer than 2^32.
  Calendar(const std::vector<double>& steps, const std::vector<EventData>& data, double now) {
    if (steps.empty()) return;
    const auto [least, longest] = std::minmax_element(steps.begin(), steps.end());
    double rate = 0;
    for (const double h : steps) rate += 1 / h;
    length_ = std::min(0.5 * *least, per_day / rate);
    const double days = *longest / length_ + 3;
    many_years_ = days > most_days;
    days_.resize(std::bit_ceil(static_cast<std::size_t>(std::min(days, most_days))));
    for (std::size_t i = 0; i < steps.size(); ++i) {
      put({steps[i], static_cast<double>(first_after(now, steps[i])), static_cast<std::uint32_t>(i), data[i]});
    }
    day_ = static_cast<std::uint64_t>(now / length_);
    open();
  }

  bool empty() const { return days_.empty(); }

  /// The next event. Precondition: not empty.
  const Entry& front() const { return today_[at_]; }

  /// The number of events after it on the same day, and the i-th entry of the day from it on.
  std::size_t ahead() const { return today_.size() - at_ - 1; }
  const Entry& ahead(std::size_t i) const { return today_[at_ + i]; }

  /// Sends the next event to its next time.
  void advance() {
    const Entry& entry = today_[at_];
    put({entry.step, entry.next + 1, entry.event, entry.data});
    if (++at_ == today_.size()) {
      ++day_;
      open();
    }
  }

 private:
  static constexpr double per_day = 1024;       ///< events that are sorted together
  static constexpr double most_days = 1 << 16;  ///< in a year

  static bool before(const Entry& a, const Entry& b) {
    return a.time() != b.time() ? a.time() < b.time() : a.event < b.event;
  }

  /// Their number is a power of two.
  std::vector<Entry>& page(std::uint64_t day) { return days_[day & (days_.size() - 1)]; }

  std::uint64_t day_of(const Entry& entry) const { return static_cast<std::uint64_t>(entry.time() / length_); }

  void put(const Entry& entry) { page(day_of(entry)).push_back(entry); }

  /// Moves to the next day that has an event.
  void open() {
    for (today_.clear(); today_.empty(); ++day_) take(page(day_));
    --day_;
    sort_nearly_sorted();
    at_ = 0;
  }

  void take(std::vector<Entry>& entries) {
    if (entries.empty()) return;
    if (!many_years_) {
      sort_into_buckets(entries);
      return entries.clear();
    }
    const auto later =
        std::stable_partition(entries.begin(), entries.end(), [this](const Entry& e) { return day_of(e) == day_; });
    sort_into_buckets({entries.begin(), later});
    entries.erase(entries.begin(), later);
  }

  /// Fills today_. Counts instead of comparing: processors cannot predict a comparison of random times.
  void sort_into_buckets(std::span<const Entry> entries) {
    const std::size_t n = entries.size();
    const double begin = static_cast<double>(day_) * length_, buckets_a_second = static_cast<double>(n) / length_;
    buckets_.resize(n);
    begins_.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const auto bucket = static_cast<std::int64_t>((entries[i].time() - begin) * buckets_a_second);
      buckets_[i] = static_cast<std::uint32_t>(std::clamp<std::int64_t>(bucket, 0, static_cast<std::int64_t>(n) - 1));
      ++begins_[buckets_[i] + 1];
    }
    for (std::size_t i = 1; i < n; ++i) begins_[i] += begins_[i - 1];
    today_.resize(n);
    for (std::size_t i = 0; i < n; ++i) today_[begins_[buckets_[i]]++] = entries[i];
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
  std::vector<Entry> today_;                     ///< sorted
  std::vector<std::uint32_t> buckets_, begins_;  ///< for sort_into_buckets; meaningless between calls
  std::size_t at_ = 0;
  bool many_years_ = false;
};

/// The forces of one kind as bytes.
class ForceTable {
 public:
  static constexpr std::size_t most_vertices = 4;  ///< of a force

  ForceTable() = default;

  /// `first`: the number of the first force. The forces must outlive this.
  template <class F>
  ForceTable(const std::vector<F>& forces, std::size_t first) : first_(first) {
    static_assert(F::size <= most_vertices);
    if (forces.empty()) return;
    stride_ = sizeof(F);
    last_ = F::size - 1;
    forces_ = reinterpret_cast<const std::byte*>(forces.data());
    vertices_ = reinterpret_cast<const std::byte*>(forces.front().vertices.data());
  }

  std::size_t first() const { return first_; }

  /// Calls each(vertex) four times, for all vertices of a force; for some more than once.
  template <class Each>
  void for_each_vertex(std::size_t number, const Each& each) const {
    static_assert(most_vertices == 4);
    const auto* const vertices = reinterpret_cast<const VertexId*>(vertices_ + (number - first_) * stride_);
    for (std::size_t i = 0; i < most_vertices; ++i) each(vertices[std::min(i, last_)]);
  }

  void prefetch(std::size_t number) const {
    const std::byte* const force = forces_ + (number - first_) * stride_;
    __builtin_prefetch(force);
    __builtin_prefetch(force + stride_ - 1);
  }

 private:
  const std::byte* forces_ = nullptr;
  const std::byte* vertices_ = nullptr;  ///< of the first force
  std::size_t first_ = 0, stride_ = 0, last_ = 0;
};

/// Finds out whether forces have a vertex in common.
class VertexMarks {
 public:
  explicit VertexMarks(std::size_t vertex_count = 0) : marked_(vertex_count, 0) {}

  /// Forgets all marks.
  void clear() {
    if (++round_ != 0) return;
    std::fill(marked_.begin(), marked_.end(), 0);  // once in 2^32 rounds
    round_ = 1;
  }

  /// Marks the vertices of a force, unless one of them is taken; returns whether it did.
  bool mark(const ForceTable& table, std::size_t number) {
    bool taken = false;
    table.for_each_vertex(number, [&](VertexId v) { taken |= marked_[v] == round_; });
    if (!taken) table.for_each_vertex(number, [&](VertexId v) { marked_[v] = round_; });
    return !taken;
  }

 private:
  std::vector<std::uint32_t> marked_;  ///< by vertex: the last round in which it was marked
  std::uint32_t round_ = 0;
};

/// The clocks of forces of `Kinds` kinds.
template <std::size_t Kinds>
class OwnClocks {
 public:
  static constexpr std::size_t longest_row = 64;

  OwnClocks() = default;

  /// `calendar`: of all forces, by number; its entries say in which table each force is.
  OwnClocks(const std::array<ForceTable, Kinds>& tables, Calendar calendar, std::size_t vertex_count)
      : calendar_(std::move(calendar)), tables_(tables), marks_(vertex_count) {}

  bool empty() const { return calendar_.empty(); }
  /// The time of the next force. Precondition: not empty.
  double next_time() const { return calendar_.front().time(); }

  /// Takes the next row: at least one force, at most `longest`, while is_due(). Calls `prefetch` with vertices that
  /// will be needed.
  template <class IsDue, class Prefetch>
  void take_row(std::size_t longest, const IsDue& is_due, const Prefetch& prefetch) {
    sizes_ = {};
    marks_.clear();
    for (std::size_t size = 0; size < longest && is_due(); ++size) {
      const Calendar::Entry& entry = calendar_.front();
      const auto [kind, carries] = entry.data;
      const ForceTable& table = tables_[kind];
      if (!marks_.mark(table, entry.event)) return;
      row_[kind][sizes_[kind]++] = {entry.time(), entry.step, entry.event - table.first(), carries,
                                    (entry.next + 1) * entry.step};
      look_ahead(prefetch);
      calendar_.advance();
    }
  }

  /// The forces of the row that are of this kind.
  std::span<const DueForce> row(std::size_t kind) const { return {row_[kind].data(), sizes_[kind]}; }

 private:
  template <class Prefetch>
  void look_ahead(const Prefetch& prefetch) const {
    constexpr std::size_t far = 24, near = 12;
    if (calendar_.ahead() < far) return;
    const Calendar::Entry &later = calendar_.ahead(far), &soon = calendar_.ahead(near);
    tables_[later.data.kind].prefetch(later.event);
    tables_[soon.data.kind].for_each_vertex(soon.event, prefetch);
  }

  Calendar calendar_;
  std::array<ForceTable, Kinds> tables_;
  VertexMarks marks_;
  std::array<std::array<DueForce, longest_row>, Kinds> row_{};
  std::array<std::size_t, Kinds> sizes_{};
};

}  // namespace noli::integrator
