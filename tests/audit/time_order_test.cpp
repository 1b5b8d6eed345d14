// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/time_order.h"

#include <gtest/gtest.h>

namespace noli::audit {
namespace {

/// The first tie of two clocks in ]0, end].
std::optional<TimeTie> tie_of(const TimedClock& a, const TimedClock& b, double end) {
  std::vector<TimedEvent> events;
  add_events(a, 0, end, events);
  add_events(b, 0, end, events);
  return first_tie(events);
}

// 3 (1 + 2^-52) is 3 + 3/2 ulp, which is rounded to 3 + 2 ulp.
constexpr double odd = 1 + 0x1p-52, after_three = 3 + 0x1p-50;

TEST(TimeOrder, EventsAreMultiplesOfAStep) {
  std::vector<TimedEvent> events;
  const TimedClock clock{0.25, "a", 0};
  add_events(clock, 0.5, 1, events);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].k, 3U);
  EXPECT_EQ(events[1].time, 1);
}

TEST(TimeOrder, SeesWhatRoundingTurnsRound) {
  ASSERT_EQ(3 * odd, after_three);
  const auto tie = tie_of({odd, "early", 2}, {after_three, "late", 1}, 5);
  ASSERT_TRUE(tie);
  EXPECT_EQ(*tie, (TimeTie{after_three, "early", "late"}));
}

TEST(TimeOrder, IsContentWithTiesInTheRightOrder) {
  EXPECT_FALSE(tie_of({odd, "early", 1}, {after_three, "late", 2}, 5));
}

TEST(TimeOrder, IsContentWithTimesThatAreEqual) {
  EXPECT_FALSE(tie_of({0.1, "a", 2}, {0.2, "b", 1}, 10));
  EXPECT_FALSE(tie_of({odd, "a", 2}, {0.5 * odd, "b", 1}, 10));
}

TEST(TimeOrder, LooksAtNothingBehindTheEnd) { EXPECT_FALSE(tie_of({odd, "early", 2}, {after_three, "late", 1}, 2.5)); }

}  // namespace
}  // namespace noli::audit
