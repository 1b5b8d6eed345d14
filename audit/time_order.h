// SPDX-License-Identifier: Apache-2.0
//
// Event times in higher precision: would the events of a run still come in the same order?
//
// Notation
//   k, h    an event's time is fl(k h), h being its clock's step; exactly it is k h, a product of two numbers of 53 bits
//   tie     two events of the same time fl(k h) = fl(k' h') although k h != k' h'
// Rounding is monotone, so events that are apart in double have the order of their exact times: only ties can change it.
// What was simultaneous, all impulses acting on the positions of one time, then comes one after the other.
//
// What this does not do: certificates are no events of the motion, and scripts' breakpoints have exact times.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace noli::audit {

/// Something that happens at the times k h.
struct TimedClock {
  double step = 0;  ///< h [s]
  std::string name;
};

/// One event of a clock.
struct TimedEvent {
  double time = 0;  ///< fl(k h)
  std::uint64_t k = 0;
  const TimedClock* clock = nullptr;
};

/// The first of two events that double makes simultaneous.
struct TimeTie {
  double time = 0;            ///< of both [s]
  std::string first, second;  ///< in the order of exact times
  friend bool operator==(const TimeTie&, const TimeTie&) = default;
};

/// The events of a clock in ]begin, end], added to `events`.
void add_events(const TimedClock& clock, double begin, double end, std::vector<TimedEvent>& events);

/// The first tie among events, which are put into the order of their times; of several at one time, that of the least
/// exact times.
std::optional<TimeTie> first_tie(std::vector<TimedEvent>& events);

}  // namespace noli::audit
