// SPDX-License-Identifier: Apache-2.0
//
// The back ends of parallel.h. A back end only calls a *lane* on several threads at once; each lane takes the next
// index until none is left. So indices and exceptions are handled once, for both back ends.
#include "kernel/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#ifdef NOLI_PARALLEL_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/scalable_allocator.h>
#include <tbb/task_arena.h>
#endif

namespace noli {
namespace {

using Task = std::function<void(std::size_t)>;

/// The indices still to be done, and the exception of the lowest index that threw.
class Loop {
 public:
  Loop(std::size_t count, const Task& task) : count_(count), task_(task), limit_(count) {}

  /// Takes indices until none is left. Called from several threads.
  void lane() noexcept {
    for (std::size_t i = next_++; i < count_; i = next_++) {
      if (i < limit_.load(std::memory_order_relaxed)) call(i);
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void call(std::size_t i) noexcept {
    try {
      task_(i);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (i >= limit_.load(std::memory_order_relaxed)) return;
      // Only indices above a failed one are skipped, so the lowest failure always runs.
      limit_.store(i, std::memory_order_relaxed);
      error_ = std::current_exception();
    }
  }

  const std::size_t count_;
  const Task& task_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> limit_;
  std::mutex mutex_;
  std::exception_ptr error_;
};

int wanted(int threads) { return threads > 0 ? threads : hardware_threads(); }

int lane_count(std::size_t count, int threads) {
  return static_cast<int>(std::min(count, static_cast<std::size_t>(wanted(threads))));
}

void run_std(std::size_t count, int threads, const Task& task) {
  Loop loop(count, task);
  {
    std::vector<std::jthread> others;  // joined at the end of this block, also when a thread cannot be made
    for (int lane = 1; lane < lane_count(count, threads); ++lane) others.emplace_back([&loop] { loop.lane(); });
    loop.lane();
  }
  loop.rethrow();
}

#ifdef NOLI_PARALLEL_TBB
/// Makes this program load TBB's allocator when it starts. TBB would do so in its first loop, and glibc crashes if
/// memory ends while it loads a library.
[[gnu::used]] void (*const loads_allocator)(void*) = &scalable_free;

/// Arenas that no loop uses at the moment. TBB frees an arena only after all its threads have left it, so on a busy
/// machine a new one for each loop would pile up: 7 KB for each step of a sequence.
class Arenas {
 public:
  using Arena = std::unique_ptr<tbb::task_arena>;

  Arena take(int lanes) {
    const std::scoped_lock lock(mutex_);
    std::vector<Arena>& free = free_[lanes];
    if (free.empty()) return std::make_unique<tbb::task_arena>(lanes);
    Arena arena = std::move(free.back());
    free.pop_back();
    return arena;
  }

  void give_back(int lanes, Arena arena) {
    const std::scoped_lock lock(mutex_);
    free_[lanes].push_back(std::move(arena));
  }

 private:
  std::mutex mutex_;
  std::map<int, std::vector<Arena>> free_;  ///< by their number of lanes
};

/// Never destroyed: TBB may be gone by then.
Arenas& arenas() {
  static Arenas& all = *new Arenas;
  return all;
}

void run_tbb(std::size_t count, int threads, const Task& task) {
  const int lanes = lane_count(count, threads);
  Loop loop(count, task);
  if (lanes <= 1) {
    loop.lane();
  } else {
    // More threads than the machine has must be allowed explicitly. The least value of all live controls holds, so this
    // one must not limit loops elsewhere or nested in this one, which may have more tasks. The arena limits this loop.
    auto allow =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(std::max(wanted(threads), hardware_threads())));
    try {
      Arenas::Arena arena = arenas().take(lanes);
      arena->execute([&] {
        tbb::parallel_for(
            0, lanes, [&loop](int) { loop.lane(); }, tbb::simple_partitioner());
      });
      arenas().give_back(lanes, std::move(arena));
    } catch (...) {
      // Memory has run out within TBB. Destroying a control could then wait forever, so it is leaked.
      static_cast<void>(allow.release());
      throw;
    }
  }
  loop.rethrow();
}
constexpr std::array backends = {ParallelBackend{"tbb", run_tbb}, ParallelBackend{"std", run_std}};
#else
constexpr std::array backends = {ParallelBackend{"std", run_std}};
#endif

}  // namespace

int hardware_threads() {
  static const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));  // reads a file
  return threads;
}

void parallel_for(std::size_t count, int threads, const Task& task) { backends.front().run(count, threads, task); }

void parallel_both(int threads, const std::function<void()>& first, const std::function<void()>& second) {
  run_std(2, threads, [&](std::size_t i) { i == 0 ? first() : second(); });
}

std::span<const ParallelBackend> parallel_backends() { return backends; }

}  // namespace noli
