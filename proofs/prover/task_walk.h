// SPDX-License-Identifier: Apache-2.0
//
// Walks over some obligations, cut into tasks for several threads.
//
// Findings do not depend on the threads: they are added up in the order of the tasks. With `first_only`, tasks after
// the first that finds something do not count, because whether they ran depends on the threads.
#pragma once

#include <limits>
#include <memory>
#include <mutex>

#include "kernel/parallel.h"
#include "proofs/prover/traversal.h"

namespace noli {

/// Reports progress to the caller: one thread at a time, never backwards.
class Progress {
 public:
  explicit Progress(const VerifyOptions& options) : tell_(options.progress) {}

  /// The next `tasks` tasks take the progress from one share of the work to another.
  void begin(double from, double to, std::size_t tasks) {
    from_ = from;
    to_ = to;
    tasks_ = tasks;
    done_ = 0;
    if (tasks == 0) tell(to);
  }
  void task_done() {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    ++done_;
    const double part = static_cast<double>(done_) / static_cast<double>(tasks_);
    tell(done_ == tasks_ ? to_ : from_ + part * (to_ - from_));
  }

 private:
  void tell(double share) {
    if (!tell_ || !(share > told_)) return;
    told_ = share;
    tell_(share);
  }

  const std::function<void(double)>& tell_;
  double from_ = 0, to_ = 0, told_ = 0;
  std::size_t tasks_ = 0, done_ = 0;
  std::mutex mutex_;
};

/// The result of a walk.
template <class Positions, class Out>
struct WalkOutcome {
  typename Positions::Tally tally;
  WalkTokens<Positions::dim, Out> out{};
  bool finished = false;
};

/// `Positions`, `Out`: as in proofs/prover/traversal.h.
template <class Positions, class Out>
class TaskWalk {
 public:
  using Outcome = WalkOutcome<Positions, Out>;

  /// `none`: an empty tally. All arguments must outlive this.
  TaskWalk(const Positions& positions, const VerifyOptions& options, const StopSignal& stop,
           const typename Positions::Tally& none)
      : positions_(positions), options_(options), stop_(stop), none_(none), top_{none} {}

  /// Walks the top of the trees over this many cells, where there is little to do: top(traversal) returns false if it
  /// did not finish. Everything below becomes tasks. A task is about at most a 256th of the cells, a 128th for the
  /// proof of a window (whose blocks end where tasks do), or Positions::least_grain if that is more.
  template <class Top>
  void cut(std::size_t cells, const Top& top) {
    Traversal<Positions, Out> traversal(positions_, options_, stop_, top_.tally, top_.out);
    constexpr std::size_t share = Out::on && !Positions::straight ? 128 : 256;
    traversal.defer(std::max(static_cast<std::uint32_t>(cells / share), Positions::least_grain), tasks_);
    top_.finished = !stop_.raised() && top(traversal);
    outcomes_.resize(tasks_.size());
    end_ = tasks_.size();
  }

  /// Keeps the tasks of this part alone. What was found in the top belongs to the first part.
  void keep(const StepPart& part) {
    first_ = tasks_.size() * part.index / part.of;
    end_ = tasks_.size() * (part.index + 1) / part.of;
    if (part.index > 0) top_.tally = none_;
  }

  /// Settles the tasks; calls done(task) after each, from any thread. Then adds up the findings.
  template <class Done>
  void run(const Done& done) {
    parallel_for(task_count(), options_.threads, [&](std::size_t k) {
      const std::size_t i = first_ + k;
      if (i > first_found_) return;
      run_task(i);
      done(i);
    });
    for (std::size_t i = first_; i < end_ && i <= first_found_; ++i) {
      top_.tally += outcomes_[i]->tally;
      top_.finished = top_.finished && outcomes_[i]->finished;
    }
  }

  /// The tally of everything, and the tokens of the top; the tokens of each task follow at tokens_before.
  Outcome& sum() { return top_; }
  const std::vector<Deferred>& tasks() const { return tasks_; }
  /// Those that are kept.
  std::size_t first_task() const { return first_; }
  std::size_t task_count() const { return end_ - first_; }
  Outcome& outcome(std::size_t task) { return *outcomes_[task]; }

 private:
  void run_task(std::size_t i) {
    outcomes_[i] = std::make_unique<Outcome>(Outcome{none_});
    Outcome& outcome = *outcomes_[i];
    Traversal<Positions, Out> traversal(positions_, options_, stop_, outcome.tally, outcome.out);
    outcome.finished = traversal.run(tasks_[i].obligation);
    if (options_.first_only && outcome.tally.found_any()) lower_first_found(i);
  }

  void lower_first_found(std::size_t i) {
    std::size_t before = first_found_;
    while (i < before && !first_found_.compare_exchange_weak(before, i)) {
    }
  }

  const Positions& positions_;
  const VerifyOptions& options_;
  const StopSignal& stop_;
  const typename Positions::Tally& none_;
  std::vector<Deferred> tasks_;
  std::size_t first_ = 0, end_ = 0;                 ///< the tasks that are kept
  std::vector<std::unique_ptr<Outcome>> outcomes_;  ///< of the tasks that have begun
  std::atomic<std::size_t> first_found_ = std::numeric_limits<std::size_t>::max();
  Outcome top_;  ///< of the walk over the top, then the sum of all
};

}  // namespace noli
