// SPDX-License-Identifier: Apache-2.0
//
// Numbers of pairs, found by who is in the pair.
//
// Pairs are kept in short lists, one for each vertex, by the first vertex of a pair: who asks for one pair after
// another along a surface finds them where the last ones were. (In one hash table of some million pairs nearly every
// question waited for memory; that was half of the time of a stack of sheets.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "certificates/stencil.h"

namespace noli::certificates {

class PairNumbers {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  explicit PairNumbers(std::size_t vertex_count) : lists_(vertex_count) {}

  /// Precondition: the pair is not there.
  void add(const Stencil& s, std::uint32_t number) { list(s).push_back({s.key, number}); }

  /// Precondition: the pair is there.
  void remove(const Stencil& s) {
    auto& pairs = list(s);
    std::size_t at = 0;
    while (pairs[at].key != s.key) ++at;
    pairs[at] = pairs.back();
    pairs.pop_back();
  }

  /// Or none.
  std::uint32_t find(const Stencil& s) const {
    for (const Entry& entry : lists_[s.vertices[0]]) {
      if (entry.key == s.key) return entry.number;
    }
    return none;
  }

  /// Throws std::out_of_range if the pair is not there.
  std::uint32_t at(const Stencil& s) const {
    const std::uint32_t number = find(s);
    if (number == none) throw std::out_of_range("certificates: a pair is not among those that are numbered");
    return number;
  }

  /// Gives each pair the number that renumber(number) returns, in ascending order of first vertices.
  template <class Renumber>
  void renumber(const Renumber& renumber) {
    for (auto& pairs : lists_) {
      for (Entry& entry : pairs) entry.number = renumber(entry.number);
    }
  }

  void clear() {
    for (auto& pairs : lists_) pairs.clear();
  }

  void swap(PairNumbers& other) { lists_.swap(other.lists_); }

 private:
  struct Entry {
    PairKey key;
    std::uint32_t number;
  };

  std::vector<Entry>& list(const Stencil& s) { return lists_[s.vertices[0]]; }

  std::vector<std::vector<Entry>> lists_;  ///< by first vertex
};

}  // namespace noli::certificates
