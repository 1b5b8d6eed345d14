// SPDX-License-Identifier: Apache-2.0
//
// Passes on the proof of a step while the step is decided, so that a checker need not wait for the end.
//
// The tokens of a task are final when it has ended, if it found nothing and left no parts open (step_tokens.h). They
// are passed on in the order of the tasks, by a thread that has just ended one. At the first task that is not final
// this stops for good: whether its tokens are needed is known when the whole step is decided. It begins when a 16th of
// the tasks has ended: where there are contacts, most motions show one by then, and nothing was passed on in vain.
#pragma once

#include <mutex>
#include <span>
#include <string_view>
#include <vector>

#include "proofs/prover/task_walk.h"

namespace noli {

/// `Walk`: a TaskWalk with tokens, which is about to run.
template <class Walk>
class EarlyTokens {
 public:
  /// Passes on the tree. Both arguments must outlive this.
  EarlyTokens(Walk& walk, std::span<const std::uint32_t> leaf_cells, ProofReceiver& receiver)
      : walk_(walk), receiver_(receiver), final_(walk.task_count(), false), next_(walk.first_task()) {
    receiver_.tree(leaf_cells);
  }

  /// To be called when a task has ended, from any thread. Throws what the receiver throws.
  void task_done(std::size_t task) {
    const auto& outcome = walk_.outcome(task);
    std::unique_lock lock(mutex_);
    final_[task - walk_.first_task()] = outcome.finished && outcome.out.open.empty() && !outcome.tally.found_any();
    found_ = found_ || outcome.tally.found_any();
    if (++ended_ < final_.size() / 16) return;
    if (passing_) return;  // that thread looks again before it stops
    passing_ = true;
    while (next_is_final()) {
      const std::size_t now = next_++;
      lock.unlock();
      pass(now);
      lock.lock();
    }
    passing_ = false;
  }

  /// The first task whose tokens were not passed on.
  std::size_t next() const { return next_; }

 private:
  bool next_is_final() const {
    const std::size_t i = next_ - walk_.first_task();
    return !found_ && i < final_.size() && final_[i];
  }

  void pass(std::size_t task) {
    const auto take = [this](std::string_view bytes) { receiver_.tokens(bytes); };
    const auto& tasks = walk_.tasks();
    walk_.sum().out.tokens.give(task == 0 ? 0 : tasks[task - 1].tokens_before, tasks[task].tokens_before, take);
    Tokens& tokens = walk_.outcome(task).out.tokens;
    tokens.give(take);
    tokens = {};
  }

  Walk& walk_;
  ProofReceiver& receiver_;
  std::mutex mutex_;
  std::vector<bool> final_;  ///< by task, of those that have ended
  std::size_t next_;
  std::size_t ended_ = 0;  ///< how many
  bool passing_ = false;   ///< a thread is passing tokens on
  bool found_ = false;     ///< there is a contact, so there will be no proof
};

}  // namespace noli
