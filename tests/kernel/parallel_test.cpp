// SPDX-License-Identifier: Apache-2.0
#include "kernel/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <numeric>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace noli {

void PrintTo(const ParallelBackend& backend, std::ostream* out) { *out << backend.name; }

namespace {

constexpr std::array thread_counts = {1, 2, 5, 0};

/// Work of uneven length whose result depends only on the order of its own additions.
double uneven_sum(std::size_t i) {
  double sum = 0;
  for (std::size_t k = 1; k <= 1 + (i * 37) % 500; ++k) sum += 1.0 / static_cast<double>(k + i);
  return sum;
}

std::vector<double> serial(std::size_t count) {
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = uneven_sum(i);
  return out;
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class EachBackend : public testing::TestWithParam<ParallelBackend> {};

TEST_P(EachBackend, CallsEveryIndexOnce) {
  for (const int threads : thread_counts) {
    std::vector<std::atomic<int>> calls(1000);
    GetParam().run(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const auto& n) { return n == 1; })) << threads << " threads";
  }
}

TEST_P(EachBackend, NothingToDo) {
  for (const int threads : thread_counts) {
    GetParam().run(0, threads, [](std::size_t) { FAIL() << "called without an index"; });
  }
}

TEST_P(EachBackend, GivesTheBytesOfASerialLoop) {
  const std::vector<double> expected = serial(2000);
  for (const int threads : thread_counts) {
    std::vector<double> out(expected.size());
    GetParam().run(out.size(), threads, [&](std::size_t i) { out[i] = uneven_sum(i); });
    EXPECT_TRUE(same_bytes(out, expected)) << threads << " threads";
  }
}

/// Holds every task until `threads` of them run at once (or a second has passed), and returns the number of threads
/// seen.
std::size_t threads_seen(const ParallelBackend& backend, int threads) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(1);
  backend.run(64, threads, [&](std::size_t) {
    {
      const std::scoped_lock lock(mutex);
      seen.insert(std::this_thread::get_id());
    }
    const auto waiting = [&] {
      const std::scoped_lock lock(mutex);
      return seen.size() < static_cast<std::size_t>(threads);
    };
    while (waiting() && std::chrono::steady_clock::now() < give_up) std::this_thread::yield();
  });
  return seen.size();
}

TEST_P(EachBackend, UsesAsManyThreadsAsAskedForAndNoMore) {
  for (const int threads : {1, 2, 5}) EXPECT_EQ(threads_seen(GetParam(), threads), threads);
}

TEST_P(EachBackend, RethrowsTheLowestIndexThatThrows) {
  for (const int threads : thread_counts) {
    for (int repetition = 0; repetition < 20; ++repetition) {
      try {
        GetParam().run(500, threads, [](std::size_t i) {
          if (i % 100 == 42) throw std::runtime_error(std::to_string(i));
        });
        ADD_FAILURE() << "did not throw";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "42") << threads << " threads";
      }
    }
  }
}

TEST_P(EachBackend, RunsEverythingBelowAFailedIndex) {
  for (const int threads : thread_counts) {
    std::vector<std::atomic<int>> calls(400);
    const auto task = [&](std::size_t i) {
      ++calls[i];
      if (i == 300) throw std::runtime_error("at 300");
    };
    EXPECT_THROW(GetParam().run(calls.size(), threads, task), std::runtime_error);
    EXPECT_TRUE(std::all_of(calls.begin(), calls.begin() + 301, [](const auto& n) { return n == 1; }));
    EXPECT_TRUE(std::all_of(calls.begin() + 301, calls.end(), [](const auto& n) { return n <= 1; }));
  }
}

TEST_P(EachBackend, AloneStopsAtTheFailedIndex) {
  std::size_t calls = 0;
  const auto task = [&](std::size_t) {
    if (++calls == 3) throw std::runtime_error("third");
  };
  EXPECT_THROW(GetParam().run(10, 1, task), std::runtime_error);
  EXPECT_EQ(calls, 3U);
}

TEST_P(EachBackend, Nests) {
  std::vector<std::uint64_t> sums(20);
  GetParam().run(sums.size(), 2, [&](std::size_t i) {
    std::vector<std::uint64_t> inner(50);
    GetParam().run(inner.size(), 2, [&](std::size_t k) { inner[k] = i * k; });
    sums[i] = std::accumulate(inner.begin(), inner.end(), std::uint64_t{0});
  });
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_EQ(sums[i], i * 1225);
}

INSTANTIATE_TEST_SUITE_P(Parallel, EachBackend,
                         testing::ValuesIn(parallel_backends().begin(), parallel_backends().end()),
                         [](const auto& backend) { return std::string(backend.param.name); });

TEST(Parallel, BackendsGiveTheSameBytes) {
  const std::vector<double> expected = serial(3000);
  for (const ParallelBackend& backend : parallel_backends()) {
    std::vector<double> out(expected.size());
    backend.run(out.size(), 3, [&](std::size_t i) { out[i] = uneven_sum(i); });
    EXPECT_TRUE(same_bytes(out, expected)) << backend.name;
  }
}

TEST(Parallel, TheComparisonOfBytesNoticesOneUlp) {
  std::vector<double> changed = serial(10);
  changed[7] = std::nextafter(changed[7], 1e9);
  EXPECT_FALSE(same_bytes(changed, serial(10)));
}

TEST(Parallel, TheBuildHasTheBackendsItWasAskedFor) {
#ifdef NOLI_PARALLEL_TBB
  ASSERT_EQ(parallel_backends().size(), 2U);
  EXPECT_EQ(parallel_backends().front().name, "tbb");
#else
  ASSERT_EQ(parallel_backends().size(), 1U);
#endif
  EXPECT_EQ(parallel_backends().back().name, "std");
}

TEST(Parallel, TheLoopOfTheBuildRuns) {
  std::vector<double> out(100);
  parallel_for(out.size(), 0, [&](std::size_t i) { out[i] = uneven_sum(i); });
  EXPECT_TRUE(same_bytes(out, serial(100)));
  EXPECT_GE(hardware_threads(), 1);
}

TEST(Parallel, BothAreCalledOnce) {
  for (const int threads : thread_counts) {
    int first = 0, second = 0;
    parallel_both(
        threads, [&] { ++first; }, [&] { ++second; });
    EXPECT_EQ(first, 1) << threads << " threads";
    EXPECT_EQ(second, 1) << threads << " threads";
  }
}

TEST(Parallel, BothGoOnAtOnceUnlessThereIsOneThread) {
  std::set<std::thread::id> threads;
  parallel_both(
      1, [&] { threads.insert(std::this_thread::get_id()); }, [&] { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads.size(), 1U);
  std::atomic<int> begun = 0;  // each waits for the other
  const auto wait_for_other = [&] {
    ++begun;
    while (begun < 2) std::this_thread::yield();
  };
  parallel_both(2, wait_for_other, wait_for_other);
  EXPECT_EQ(begun, 2);
}

TEST(Parallel, OfBothTheFirstExceptionCounts) {
  for (const int threads : {1, 2}) {
    const auto fail = [](const char* what) { return [what] { throw std::runtime_error(what); }; };
    try {
      parallel_both(threads, fail("first"), fail("second"));
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "first");
    }
    EXPECT_THROW(parallel_both(
                     threads, [] {}, fail("second")),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace noli
