// SPDX-License-Identifier: Apache-2.0
#include "integrator/own_clocks.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>
#include <tuple>

namespace noli::integrator {
namespace {

/// Gives events as (time, number) from a sorted set, in the order that the calendar must follow.
class Reference {
 public:
  Reference(const std::vector<double>& steps, double now) {
    for (const double h : steps) clocks_.push_back({h, first_after(now, h)});
    for (std::size_t i = 0; i < steps.size(); ++i) queue_.emplace(clocks_[i].time(), i);
  }

  std::pair<double, std::size_t> take() {
    const auto first = *queue_.begin();
    queue_.erase(queue_.begin());
    ++clocks_[first.second].next;
    queue_.emplace(clocks_[first.second].time(), first.second);
    return first;
  }

 private:
  std::vector<Clock> clocks_;
  std::set<std::pair<double, std::size_t>> queue_;
};

std::vector<Calendar::EventData> data_of(std::size_t count) {
  std::vector<Calendar::EventData> data;
  for (std::size_t i = 0; i < count; ++i) {
    data.push_back({static_cast<std::uint16_t>(i % 3), static_cast<std::uint16_t>(i % 7)});
  }
  return data;
}

void expect_order(const std::vector<double>& steps, double now, int events) {
  Calendar calendar(steps, data_of(steps.size()), now);
  Reference reference(steps, now);
  for (int i = 0; i < events; ++i) {
    const auto [time, event] = reference.take();
    ASSERT_FALSE(calendar.empty());
    ASSERT_EQ(calendar.front().time(), time) << i;
    ASSERT_EQ(calendar.front().event, event) << i;
    ASSERT_EQ(calendar.front().data.kind, event % 3) << i;
    ASSERT_EQ(calendar.front().data.carries, event % 7) << i;
    ASSERT_GT(time, now);
    calendar.advance();
  }
}

TEST(Calendar, WithoutEventsIsEmpty) { EXPECT_TRUE(Calendar({}, {}, 0).empty()); }

TEST(Calendar, GivesEventsByTimeThenByNumber) {
  std::mt19937_64 random(7);
  for (const std::size_t count : {1, 2, 30, 3000}) {
    for (const double spread : {1.0, 1.5, 100.0}) {
      std::vector<double> steps(count);
      for (double& h : steps) h = 1e-4 * (1 + (spread - 1) * std::generate_canonical<double, 53>(random));
      expect_order(steps, 0, 20'000);
      expect_order(steps, 12.3, 20'000);
    }
  }
}

TEST(Calendar, EqualTimesComeByNumber) {
  std::vector<double> steps(500);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = std::ldexp(1.0, -static_cast<int>(i * 7 % 5));
  expect_order(steps, 0, 50'000);
  expect_order(std::vector<double>(100, 0.1), 0.7, 10'000);
}

TEST(Calendar, OneStepMayBeFarLongerThanTheOthers) { expect_order({1e-4, 1e-4, 3.0, 1e-4}, 0, 200'000); }

/// Steps longer than the calendar: the calendar passes the event's page more than once before its time.
TEST(Calendar, EventsWaitForAnotherYear) {
  expect_order({1e-6, 0.5, 0.3, 20.0}, 0, 1'100'000);
  expect_order({1e-6, 0.5, 0.3, 1e6}, 5.1, 600'000);
}

}  // namespace
}  // namespace noli::integrator
