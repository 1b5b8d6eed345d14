// SPDX-License-Identifier: Apache-2.0
//
// The verifier's walk over pairs of groups.
//
// Notation
//   obligation  as in proofs/FORMAT.md: a pair of groups, or one with itself
//   grain       obligations about at most this many cells are deferred, if a list for them is given. So the work is cut
//               into tasks that do not depend on the number of threads
//   positions   the positions of vertices, and boxes around them: Straight (proofs/prover/straight.h) between two
//               frames, Chords (proofs/prover/windows/chords.h) in a window
//
// proofs/prover/task_walk.h runs tasks on threads and adds up their findings.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <optional>
#include <vector>

#include "proofs/prover/cell_pair.h"
#include "proofs/prover/group_pair.h"
#include "proofs/prover/hierarchy.h"

namespace noli {

/// An obligation that was deferred, and the place of its tokens.
struct Deferred {
  Obligation obligation;
  std::size_t tokens_before = 0;
};

/// When to give up. One object for all threads.
class StopSignal {
 public:
  explicit StopSignal(const VerifyOptions& options) : stop_(options.stop), deadline_(options.deadline) {}

  bool raised() const {
    return (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) ||
           (deadline_ && std::chrono::steady_clock::now() >= *deadline_);
  }

 private:
  const std::atomic<bool>* stop_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

/// `Positions`: Straight or Chords. `Out`: Tokens, or NoTokens.
template <class Positions, class Out>
class Traversal {
 public:
  using Tally = typename Positions::Tally;

  Traversal(const Positions& positions, const VerifyOptions& options, const StopSignal& stop, Tally& tally,
            WalkTokens<Positions::dim, Out>& out)
      : positions_(positions),
        first_only_(options.first_only),
        stop_(stop),
        tally_(tally),
        tokens_(out.tokens),
        cell_pairs_(about_cells(options, positions), positions_, tally, out) {}

  /// From now on defers obligations about at most `grain` cells to the list.
  void defer(std::uint32_t grain, std::vector<Deferred>& list) {
    grain_ = grain;
    deferred_ = &list;
  }

  /// Settles an obligation. False if it ended early: it was stopped, or found a contact with first_only.
  bool run(const Obligation& obligation) {
    stopped_ = stop_.raised();
    closed_ = 0;
    positions_.begin(obligation);
    stack_.clear();
    stack_.push({obligation.first, obligation.second}, 0);
    while (!stack_.empty() && !stopped_) take_next();
    tally_.obligations += closed_;
    return !stopped_;
  }

 private:
  /// What cells are looked at for. Of a window, only the first span begins where the window does.
  static CellOptions about_cells(const VerifyOptions& options, const Positions& positions) {
    const bool begins = positions.from_the_beginning();
    return {options.initial && begins, options.after_step && begins, options.strict, options.baseline};
  }

  /// The number of pairs of groups between two checks of the clock.
  static constexpr unsigned patience = 4096;
  /// Each of at most 32 levels leaves two obligations on the stack when a self is split, and three when a pair is.
  static constexpr std::size_t stack_size = 32 * (2 + 3);

  /// Notes about a pair on the stack, with tokens: the code of the axis that has closed it, if not 0; and whether the
  /// second group was split just before.
  static constexpr std::uint8_t axis_code = 0x0f, after_split = 0x80;

  [[gnu::always_inline]] void take_next() {
    stack_.pop();
    const GroupPair pair = stack_.popped();
    if constexpr (Out::on) {
      const std::uint8_t notes = stack_.popped_notes();
      if ((notes & after_split) != 0) tokens_.right();
      if ((notes & axis_code) != 0) return tokens_.axis(notes & axis_code);
    }
    if (positions_.left_out(pair)) return tokens_.excluded();
    if (!Out::on && positions_.settled_at_once(pair)) {
      ++closed_;
      return;
    }
    if (put_off(pair)) return;
    if (pair.is_self()) return take_self(pair);
    if (++since_look_ >= patience) look_at_clock();
    take_apart(pair);
  }

  bool put_off(const GroupPair& pair) {
    if (deferred_ == nullptr) return false;
    const std::uint32_t size = pair.first().count + (pair.is_self() ? 0 : pair.second().count);
    if (size <= grain_) deferred_->push_back({{pair.first(), pair.second()}, tokens_.place()});
    return size <= grain_;
  }

  void take_self(const GroupPair& pair) {
    if (pair.both_leaves()) {
      cell_pairs_.settle_self(positions_.cell(pair.first()));
      return look_around();
    }
    const Group left = pair.first().left(), right = pair.first().right();
    tokens_.parts();
    stack_.push({right, right}, 0);
    push_tested({left, right});
    stack_.push({left, left}, 0);
  }

  /// Takes apart a pair that no axis separates. Splits both groups at once: testing one against half of the other
  /// usually fails.
  [[gnu::always_inline]] void take_apart(const GroupPair& pair) {
    if (pair.both_leaves()) {
      cell_pairs_.settle(positions_.cell(pair.first()), positions_.cell(pair.second()));
      look_around();
    } else if (pair.second_is_leaf()) {
      tokens_.left();
      push_tested(pair.right_whole());
      push_tested(pair.left_whole());
    } else if (pair.first_is_leaf()) {
      tokens_.right();
      push_tested(pair.whole_right());
      push_tested(pair.whole_left());
    } else {
      tokens_.left();
      push_halves(pair.right_left(), pair.right_right());
      push_halves(pair.left_left(), pair.left_right());
    }
  }

  /// Pushes half of the first group with both halves of the second.
  [[gnu::always_inline]] void push_halves(const GroupPair& left, const GroupPair& right) {
    if constexpr (!Out::on) {
      push_tested(right);
      push_tested(left);
    } else {
      const unsigned of_left = order_of(left), of_right = order_of(right);
      closed_ += (of_left != 0 ? 1 : 0) + (of_right != 0 ? 1 : 0);
      // An axis that separates both halves separates the whole, with one token.
      if ((of_left & of_right) != 0) return stack_.push(left, Tokens::axis_code_of(of_left & of_right));
      stack_.push(right, Tokens::axis_code_of(of_right));
      stack_.push(left, Tokens::axis_code_of(of_left) | after_split);
    }
  }

  const GroupBox& first_box(const GroupPair& pair) const { return positions_.box_of(pair.first_node()); }
  const GroupBox& second_box(const GroupPair& pair) const { return positions_.box_of(pair.second_node()); }

  /// Does not branch on whether an axis separates the two, as that cannot be predicted. A closed pair is pushed only
  /// for its token.
  [[gnu::always_inline]] void push_tested(const GroupPair& pair) {
    if constexpr (Out::on) {
      const unsigned order = order_of(pair);
      closed_ += order != 0 ? 1 : 0;
      stack_.push(pair, Tokens::axis_code_of(order));
    } else {
      const bool separated = axis_separates(first_box(pair), second_box(pair));
      closed_ += separated ? 1 : 0;
      stack_.push(pair, 0, !separated);
    }
  }

  [[gnu::always_inline]] unsigned order_of(const GroupPair& pair) const {
    return separating_axes(first_box(pair), second_box(pair));
  }

  void look_around() {
    if ((first_only_ && tally_.found_any()) || cell_pairs_.stopped()) stopped_ = true;
  }

  void look_at_clock() {
    since_look_ = 0;
    if (stop_.raised()) stopped_ = true;
  }

  Positions positions_;
  bool first_only_;
  const StopSignal& stop_;
  Tally& tally_;
  Out& tokens_;
  CellPairs<Positions, Out> cell_pairs_;
  std::uint32_t grain_ = 0;
  std::vector<Deferred>* deferred_ = nullptr;
  unsigned since_look_ = 0;
  bool stopped_ = false;
  std::uint64_t closed_ = 0;  ///< obligations closed by an axis
  GroupPairStack<stack_size> stack_;
};

}  // namespace noli
