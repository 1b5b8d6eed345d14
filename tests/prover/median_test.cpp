// SPDX-License-Identifier: Apache-2.0
//
// Compares the median split with sorting.
#include "proofs/prover/median.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace noli {
namespace {

Entry entry(std::int32_t at, std::size_t cell) { return Entry{at, -at, at / 2, static_cast<std::int32_t>(cell)}; }

bool comes_before(const Entry& a, const Entry& b, std::size_t axis) {
  return a[axis] != b[axis] ? a[axis] < b[axis] : cell_in(a) < cell_in(b);
}

std::vector<std::uint32_t> sorted_cells(std::vector<Entry>::const_iterator first,
                                        std::vector<Entry>::const_iterator last) {
  std::vector<std::uint32_t> cells;
  for (auto i = first; i != last; ++i) cells.push_back(cell_in(*i));
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// Expects the same entries before the middle as after sorting, and the same behind it.
void expect_split(std::vector<Entry> entries, std::ptrdiff_t middle, std::size_t axis) {
  std::vector<Entry> sorted = entries;
  std::sort(sorted.begin(), sorted.end(), [axis](const Entry& a, const Entry& b) { return comes_before(a, b, axis); });
  split_at(entries.data(), entries.data() + middle, entries.data() + entries.size(), axis);
  EXPECT_EQ(sorted_cells(entries.begin(), entries.begin() + middle),
            sorted_cells(sorted.begin(), sorted.begin() + middle));
  EXPECT_EQ(sorted_cells(entries.begin() + middle, entries.end()), sorted_cells(sorted.begin() + middle, sorted.end()));
}

/// Entries at positions f(i).
template <class F>
std::vector<Entry> entries_of(std::size_t count, const F& f) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < count; ++i) entries.push_back(entry(static_cast<std::int32_t>(f(i)), i));
  return entries;
}

template <class F>
void expect_splits(const F& f) {
  for (const std::size_t count : {1u, 2u, 3u, 15u, 16u, 17u, 18u, 100u, 511u, 513u, 5000u}) {
    const auto entries = entries_of(count, f);
    const auto size = static_cast<std::ptrdiff_t>(count);
    for (const std::ptrdiff_t middle : {std::ptrdiff_t{0}, size / 2, size - 1}) {
      for (std::size_t axis = 0; axis < 3; ++axis) expect_split(entries, middle, axis);
    }
  }
}

TEST(Median, SplitsAtRandom) {
  std::mt19937_64 random(1);
  expect_splits([&](std::size_t) { return random() >> 32; });
}

TEST(Median, SplitsWhatIsInOrder) {
  expect_splits([](std::size_t i) { return i; });
  expect_splits([](std::size_t i) { return -static_cast<std::int64_t>(i); });
}

TEST(Median, SplitsWhatIsAlikeByCell) {
  expect_splits([](std::size_t) { return 7; });
  expect_splits([](std::size_t i) { return i % 3; });
}

/// Values are large exactly where samples are taken, so that the sample is misleading.
TEST(Median, SplitsWhereTheSampleMisleads) {
  for (const std::size_t count : {200u, 3000u}) {
    const std::size_t size = count > 512 ? 63 : 7;
    auto entries = entries_of(count, [](std::size_t i) { return i; });
    for (std::size_t i = 0; i < size; ++i) entries[(2 * i + 1) * count / (2 * size)][0] += 1'000'000;
    expect_split(entries, static_cast<std::ptrdiff_t>(count / 2), 0);
  }
}

TEST(Median, IntegersAreOrderedAsTheirFloats) {
  const float tiny = std::numeric_limits<float>::denorm_min(), most = std::numeric_limits<float>::max();
  const std::vector<float> ascending = {-most, -1.5F, -1, -tiny, 0, tiny, 1, 1.5F, most};
  for (std::size_t i = 0; i + 1 < ascending.size(); ++i) EXPECT_LT(ordered(ascending[i]), ordered(ascending[i + 1]));
  for (const float x : ascending) EXPECT_EQ(from_ordered(ordered(x)), x);
  EXPECT_EQ(ordered(-0.0F), ordered(0.0F));
}

}  // namespace
}  // namespace noli
