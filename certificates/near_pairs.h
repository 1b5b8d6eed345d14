// SPDX-License-Identifier: Apache-2.0
//
// Stores the near pairs, by number and by their vertices.
//
// Notation: that of certificates/cells.h.
//
// Each slice has near pairs of its own, numbered as they are found; a pair keeps the layers that it had in the slice
// before. Pairs with layers can be found by their stencil, others only by their vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "certificates/near_pair.h"
#include "certificates/stencil.h"

namespace noli::certificates {

/// Numbers of pairs, found by the features of the pair.
///
/// Pairs are in short lists, one for each vertex, by the first vertex of a pair. So queries for one pair after another
/// along a surface find them close together in memory. (In one hash table of some million pairs nearly every query
/// waited for memory; that was half of the time of a stack of sheets.)
class PairNumbers {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  explicit PairNumbers(std::size_t vertex_count) : lists_(vertex_count) {}

  /// Precondition: the pair has no number.
  void add(const Stencil& s, std::uint32_t number) { list(s).push_back({s.key, number}); }

  /// Precondition: the pair has a number.
  void remove(const Stencil& s) {
    auto& pairs = list(s);
    std::size_t at = 0;
    while (pairs[at].key != s.key) ++at;
    pairs[at] = pairs.back();
    pairs.pop_back();
  }

  /// The number of a pair, or none.
  std::uint32_t find(const Stencil& s) const {
    for (const Entry& entry : lists_[s.vertices[0]]) {
      if (entry.key == s.key) return entry.number;
    }
    return none;
  }

  /// Throws std::out_of_range if the pair has no number.
  std::uint32_t at(const Stencil& s) const {
    const std::uint32_t number = find(s);
    if (number == none) throw std::out_of_range("certificates: a pair is not among those that are numbered");
    return number;
  }

  /// Replaces the number of each pair by renumber(number), in ascending order of first vertices.
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

template <int Dim>
class NearPairs {
 public:
  explicit NearPairs(std::size_t vertex_count) : of_(vertex_count), layered_(vertex_count), before_(vertex_count) {}

  std::uint32_t size() const { return static_cast<std::uint32_t>(pairs_.size()); }
  NearPair<Dim>& operator[](std::uint32_t n) { return pairs_[n]; }
  const NearPair<Dim>& operator[](std::uint32_t n) const { return pairs_[n]; }
  /// The pairs that a vertex is part of.
  const std::vector<Side>& of(VertexId v) const { return of_[v]; }

  /// Forgets all pairs, but keeps their layers.
  void begin_slice() {
    before_.clear();
    before_.swap(layered_);
    carried_.clear();
    before_.renumber([this](std::uint32_t n) {
      carried_.push_back(pairs_[n]);
      return static_cast<std::uint32_t>(carried_.size() - 1);
    });
    pairs_.clear();
    for (auto& list : of_) list.clear();
  }

  /// Adds a pair, with the layers that it had in the slice before. Precondition: it has not been added yet.
  void add(const Stencil& s, std::uint16_t material) {
    const std::uint32_t n = size();
    NearPair<Dim>& pair = pairs_.emplace_back(s, material);
    for (std::size_t k = 0; k < s.size(); ++k) of_[s.vertices[k]].emplace_back(n, k < s.first());
    const std::uint32_t before = before_.find(s);
    if (before == PairNumbers::none) return;
    pair.layers = std::exchange(carried_[before].layers, 0);
    layered_.add(s, n);
  }

  /// Calls each(LayeredPair&) for pairs that had layers and have not been added again, then forgets them.
  template <class Each>
  void for_each_left_out(const Each& each) {
    for (LayeredPair& pair : carried_) {
      if (pair.layers > 0) each(pair);
    }
    before_.clear();
  }

  /// The number of a pair with layers. Throws std::out_of_range if it has none.
  std::uint32_t number(const Stencil& s) const { return layered_.at(s); }

  /// Call this when pair n may have got its first layer or lost its last one; `had`: whether it had any before.
  void note_layers(std::uint32_t n, bool had) {
    const bool has = pairs_[n].layers > 0;
    if (has && !had) layered_.add(pairs_[n].stencil, n);
    if (had && !has) layered_.remove(pairs_[n].stencil);
  }

 private:
  std::vector<NearPair<Dim>> pairs_;
  std::vector<std::vector<Side>> of_;
  PairNumbers layered_;
  PairNumbers before_;  ///< pairs that had layers in the slice before, as places in carried_
  std::vector<LayeredPair> carried_;
};

}  // namespace noli::certificates
