// SPDX-License-Identifier: Apache-2.0
//
// Tests whether the events of a run would keep their order if their times were computed exactly.
//
// Notation
//   k, h    an event's time is fl(k h), h being its clock's step; its exact time is k h, a product of two 53-bit
//           numbers
//   rank    of two events at one time, the one of lower rank comes first
//   tie     two events with fl(k h) = fl(k' h') although k h < k' h', the first having the higher rank
// Rounding is monotone, so events at different times in double have the order of their exact times. Only ties can
// change it.
//
// Certificates are left out because they do not change the motion, and scripts because their breakpoints have exact
// times. If each force has its own clock, those of one kind share one rank: their order at one time is not examined.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace noli::audit {

/// A clock that ticks at the times k h.
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

/// Two events whose order in double is reversed.
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
