// SPDX-License-Identifier: Apache-2.0
//
// Event times in higher precision: would the events of a run still come in the same order?
//
// Notation
//   k, h    an event's time is fl(k h), h being its clock's step; exactly it is k h, a product of two numbers of 53
//           bits
//   rank    of two events of one time, the one of lower rank comes first
//   tie     two events of the same time fl(k h) = fl(k' h') although k h < k' h', the first being of higher rank
// Rounding is monotone, so events that are apart in double have the order of their exact times: only ties can change
// it.
//
// What this does not do: certificates are no events of the motion, and scripts' breakpoints have exact times. Where
// each force has a clock of its own, those of one kind have one rank: their order at one time is not looked at.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace noli::audit {

/// Something that happens at the times k h.
struct TimedClock {
  double step = 0;  ///< h [s]
  std::string name;
  std::uint64_t rank = 0;
};

/// One event of a clock.
struct TimedEvent {
  double time = 0;  ///< fl(k h)
  std::uint64_t k = 0;
  const TimedClock* clock = nullptr;
};

/// Two events that double has in the other order.
struct TimeTie {
  double time = 0;            ///< of both [s]
  std::string first, second;  ///< in the order of exact times
  friend bool operator==(const TimeTie&, const TimeTie&) = default;
};

/// The events of a clock in ]begin, end], added to `events`.
void add_events(const TimedClock& clock, double begin, double end, std::vector<TimedEvent>& events);

/// The first tie among events, which are put into the order of their exact times.
std::optional<TimeTie> first_tie(std::vector<TimedEvent>& events);

}  // namespace noli::audit
