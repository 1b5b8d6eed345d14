// SPDX-License-Identifier: Apache-2.0
//
// Two groups of a hierarchy, packed for speed.
//
// Notation
//   word    two numbers of 32 bits: of the first group in the lower half, of the second in the upper half. Operations
//           without a carry between the halves apply to both at once
//
// The walk of the verifier makes about ten of these per cell, and keeps them on a stack, word by word. Compilers often
// store structures in small pieces and load them in large ones, and the processor then stalls.
#pragma once

#include "proofs/prover/hierarchy.h"

namespace noli {

/// A pair of groups, or a group with itself (then both are the same).
struct Obligation {
  Group first;
  Group second;
};

class GroupPair {
 public:
  GroupPair(Group first, Group second)
      : node_(word(first.node, second.node)),
        begin_(word(first.begin, second.begin)),
        count_(word(first.count, second.count)) {}

  std::uint32_t first_node() const { return low(node_); }
  std::uint32_t second_node() const { return high(node_); }
  Group first() const { return {low(node_), low(begin_), low(count_)}; }
  Group second() const { return {high(node_), high(begin_), high(count_)}; }

  bool is_self() const { return first_node() == second_node(); }
  bool first_is_leaf() const { return low(count_) == 1; }
  bool second_is_leaf() const { return high(count_) == 1; }
  bool both_leaves() const { return count_ == ones; }

  /// Children; left_whole() is the left child of the first group with the second group, and so on. Precondition: a
  /// group that is split is not a leaf.
  GroupPair left_left() const { return {node_ + ones, begin_, half()}; }
  GroupPair right_right() const { return {node_ + 2 * half(), begin_ + half(), count_ - half()}; }
  GroupPair left_right() const { return mixed(left_left(), right_right()); }
  GroupPair right_left() const { return mixed(right_right(), left_left()); }
  GroupPair left_whole() const { return mixed(left_left(), *this); }
  GroupPair right_whole() const { return mixed(right_right(), *this); }
  GroupPair whole_left() const { return mixed(*this, left_left()); }
  GroupPair whole_right() const { return mixed(*this, right_right()); }

 private:
  using Word = std::uint64_t;
  static constexpr Word ones = 0x1'0000'0001, lower_half = 0xffff'ffff;

  GroupPair(Word node, Word begin, Word count) : node_(node), begin_(begin), count_(count) {}

  static Word word(std::uint32_t first, std::uint32_t second) { return Word{second} << 32 | first; }
  static std::uint32_t low(Word w) { return static_cast<std::uint32_t>(w); }
  static std::uint32_t high(Word w) { return static_cast<std::uint32_t>(w >> 32); }
  static Word mixed(Word first, Word second) { return (first & lower_half) | (second & ~lower_half); }

  /// The first group of one pair and the second group of another.
  static GroupPair mixed(const GroupPair& first, const GroupPair& second) {
    return {mixed(first.node_, second.node_), mixed(first.begin_, second.begin_), mixed(first.count_, second.count_)};
  }

  /// Half of each count, rounded down.
  Word half() const { return count_ >> 1 & 0x7fff'ffff'7fff'ffff; }

  template <std::size_t>
  friend class GroupPairStack;

  Word node_, begin_, count_;
};

/// A stack of at most `Size` pairs.
template <std::size_t Size>
class GroupPairStack {
 public:
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  /// Pushes a pair with notes about it, if `keep`; otherwise nothing. Does not branch on `keep`.
  void push(const GroupPair& pair, std::uint8_t notes, bool keep = true) {
    node_[size_] = pair.node_;
    begin_[size_] = pair.begin_;
    count_[size_] = pair.count_;
    notes_[size_] = notes;
    size_ += keep ? 1 : 0;
  }

  void pop() { --size_; }

  /// The last one that was popped.
  GroupPair popped() const { return {node_[size_], begin_[size_], count_[size_]}; }
  std::uint8_t popped_notes() const { return notes_[size_]; }

 private:
  using Word = GroupPair::Word;

  std::size_t size_ = 0;
  std::array<Word, Size + 1> node_, begin_, count_;
  std::array<std::uint8_t, Size + 1> notes_;
};

}  // namespace noli
