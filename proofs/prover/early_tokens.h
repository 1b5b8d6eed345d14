// SPDX-License-Identifier: Apache-2.0
//
// Passes on the proof of a step while the step is decided, so that a checker need not wait for the end.
//
// The tokens of a task are final when it has ended, if it found nothing and left no parts open. They are passed on in
// the order of the tasks, by a thread that has just ended one. This ends for good at the first task that is not final:
// open parts are closed only when the whole step is known to have no contact (proofs/prover/tokens/step_tokens.h). It
// begins when a 16th of the tasks have ended, so that a step with many contacts seldom passes on anything in vain. (In
// the three shared pairs of frames that touch, a contact is found within the first 2 % of the tasks.)
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <string_view>
#include <vector>

#include "proofs/prover/task_walk.h"
#include "proofs/prover/tokens/tokens.h"
#include "proofs/prover/verifier.h"

namespace noli {

/// `Walk`: a TaskWalk with tokens over a whole step, which is about to run.
template <class Walk>
class EarlyTokens {
 public:
  /// Passes on the tree. `walk` and `receiver` must outlive this.
  EarlyTokens(Walk& walk, std::span<const std::uint32_t> leaf_cells, ProofReceiver& receiver)
      : walk_(walk), receiver_(receiver), final_(walk.task_count(), false) {
    receiver_.tree(leaf_cells);
  }

  /// To be called when a task has ended, from any thread. Throws what the receiver throws.
  void task_done(std::size_t task) {
    const auto& outcome = walk_.outcome(task);
    std::unique_lock lock(mutex_);
    final_[task] = outcome.finished && outcome.out.open.empty() && !outcome.tally.something_meets();
    if (outcome.tally.something_meets()) found_ = true;
    if (++tasks_ended_ < final_.size() / 16) return;
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
  bool next_is_final() const { return !found_ && next_ < final_.size() && final_[next_]; }

  void pass(std::size_t task) {
    const auto take = [this](std::string_view bytes) {
      if (!found_) receiver_.tokens(bytes);
    };
    const auto& tasks = walk_.tasks();
    walk_.sum().out.tokens.give(task == 0 ? 0 : tasks[task - 1].tokens_before, tasks[task].tokens_before, take);
    Tokens& tokens = walk_.outcome(task).out.tokens;
    tokens.give(take);
    tokens = {};
  }

  Walk& walk_;
  ProofReceiver& receiver_;
  std::mutex mutex_;
  std::vector<bool> final_;  ///< whether the tokens of each task are
  std::size_t tasks_ended_ = 0;
  std::size_t next_ = 0;
  bool passing_ = false;             ///< a thread is passing tokens on
  std::atomic<bool> found_ = false;  ///< there is a contact, so there will be no proof
};

}  // namespace noli
