// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/time_order.h"

#include <algorithm>

#include "audit/numerics/mpfr_number.h"
#include "integrator/clocks.h"

namespace noli::audit {
namespace {

/// k h. Precondition: a scope of at least 106 bits, so that the product is exact.
MpfrNumber exact_time(const TimedEvent& event) {
  return MpfrNumber(static_cast<double>(event.k)) * MpfrNumber(event.clock->step);
}

}  // namespace

void add_events(const TimedClock& clock, double begin, double end, std::vector<TimedEvent>& events) {
  for (std::uint64_t k = integrator::first_after(begin, clock.step);; ++k) {
    const double time = static_cast<double>(k) * clock.step;
    if (time > end) return;
    events.push_back({time, k, &clock});
  }
}

std::optional<TimeTie> first_tie(std::vector<TimedEvent>& events) {
  const MpfrScope scope({128, false});
  std::ranges::stable_sort(events, {}, &TimedEvent::time);
  for (auto group = events.begin(); group != events.end();) {
    const auto end = std::find_if(group, events.end(), [&](const TimedEvent& e) { return e.time != group->time; });
    if (end - group > 1) {
      std::ranges::stable_sort(group, end, {}, exact_time);
      for (auto next = group + 1; next != end; ++next) {
        const auto before = next - 1;
        if (before->clock->rank <= next->clock->rank || !(exact_time(*before) < exact_time(*next))) continue;
        return TimeTie{next->time, before->clock->name, next->clock->name};
      }
    }
    group = end;
  }
  return std::nullopt;
}

}  // namespace noli::audit
