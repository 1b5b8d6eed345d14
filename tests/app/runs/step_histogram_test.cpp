// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/step_histogram.h"

#include <gtest/gtest.h>

#include <cmath>

namespace noli {
namespace {

constexpr std::uint64_t whole = std::uint64_t{1} << 32;

TEST(StepHistogram, PowersOfTwoAreInTheMiddleOfTheirBins) {
  EXPECT_EQ(step_bin(1), 0);
  EXPECT_EQ(step_bin(2), 4);
  EXPECT_EQ(step_bin(0x1p-20), -80);
  EXPECT_EQ(step_bin(1.18920711500272), 1);
  EXPECT_EQ(step_bin(1.9), 4);
  EXPECT_LT(step_bin(0x1p-1074), step_bin(0x1p-1000));
}

TEST(StepHistogram, ABinHasItsLowerEndAndNotItsUpper) {
  for (const double end : {0x1.172b83c7d517bp+0, 0x1.4bfdad5362a27p+0, 0x1.8ace5422aa0dbp+0, 0x1.d5818dcfba487p+0}) {
    EXPECT_EQ(step_bin(std::nextafter(end, 0)) + 1, step_bin(end));
    EXPECT_EQ(step_bin(end), step_bin(std::nextafter(end, 2)));
    EXPECT_NEAR(bin_begin(step_bin(end)), end, 1e-15);
  }
}

/// World lines of resting vertices with breakpoints at these times.
WorldLines lines_at(const std::vector<std::vector<double>>& all) {
  std::vector<std::size_t> offsets = {0};
  std::vector<double> times;
  for (const auto& of_vertex : all) {
    times.insert(times.end(), of_vertex.begin(), of_vertex.end());
    offsets.push_back(times.size());
  }
  std::vector<Position> positions(times.size(), Position{});
  return WorldLines::from_breakpoints(std::move(offsets), std::move(times), std::move(positions), "test");
}

TEST(StepHistogram, EachFreeVertexCountsForTheTimeOfItsSteps) {
  const WorldLines lines = lines_at({{2, 3, 6}, {2, 6}, {2, 2.5, 6}});
  const std::vector<std::uint8_t> fixed = {0, 0, 1};
  const StepHistogram h = step_histogram(lines, fixed);
  EXPECT_EQ(h.smallest, 1);  // the third is not free
  const std::vector<StepHistogram::Bin> expected = {{0, whole / 4}, {step_bin(3), whole / 4 * 3}, {8, whole}};
  EXPECT_EQ(h.bins, expected);
  EXPECT_EQ(h.ticks(), 2 * whole);
  // The first and second bin reach up to 3 s.
  EXPECT_NEAR(h.quantile(0.5), bin_begin(step_bin(3) + 1), 1e-12);
}

TEST(StepHistogram, TicksAddUpWhateverTheTimes) {
  std::vector<double> times = {0.1};
  while (times.size() < 1000) times.push_back(times.back() + 1e-3 / static_cast<double>(times.size()));
  const StepHistogram h =
      step_histogram(lines_at({times, {times.front(), times.back()}}), std::vector<std::uint8_t>(2));
  EXPECT_EQ(h.ticks(), 2 * whole);
  EXPECT_GT(h.bins.size(), 20u);
}

TEST(StepHistogram, NothingFreeIsNothingCounted) {
  const StepHistogram h = step_histogram(lines_at({{0, 1}}), std::vector<std::uint8_t>{1});
  EXPECT_EQ(h, StepHistogram{});
}

TEST(StepHistogram, SumsHaveTheBinsOfBoth) {
  StepHistogram a{0.5, {{-4, 7}, {2, 1}}};
  a.add({0.25, {{-8, 3}, {2, 10}, {3, 1}}});
  EXPECT_EQ(a, (StepHistogram{0.25, {{-8, 3}, {-4, 7}, {2, 11}, {3, 1}}}));
  a.add({});
  EXPECT_EQ(a.smallest, 0.25);
  StepHistogram none;
  none.add(a);
  EXPECT_EQ(none, a);
}

}  // namespace
}  // namespace noli
