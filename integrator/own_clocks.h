// SPDX-License-Identifier: Apache-2.0
//
// Forces that each have a clock of their own: which fire next, in rows that may fire together because no two of a row
// have a vertex in common.
//
// Notation
//   number   of a force among all forces: those of one kind follow one another
//   shelf    the forces of one kind
//   row      the next forces, in the order of Calendar, as far as they have no vertex in common
//
// Such forces fire in no order that a processor could foresee: where one of them is in memory is found without a branch
// on its kind, and asked for some time before it is needed.
//
// What this does not do: it fires nothing. Forces must stay where they are in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "integrator/calendar.h"
#include "integrator/force.h"
#include "integrator/kick.h"

namespace noli::integrator {

/// The forces of one kind as bytes.
class Shelf {
 public:
  Shelf() = default;

  /// `first`: number of the first of the forces. They stay where they are.
  template <class F>
  Shelf(const std::vector<F>& forces, std::size_t first) : first_(first) {
    if (forces.empty()) return;
    stride_ = sizeof(F);
    last_ = F::size - 1;
    forces_ = reinterpret_cast<const std::byte*>(forces.data());
    vertices_ = reinterpret_cast<const std::byte*>(forces.front().vertices.data());
  }

  std::size_t first() const { return first_; }

  /// Calls each(vertex) four times, for all vertices of a force; of some more than once.
  template <class Each>
  void for_each_vertex(std::size_t number, const Each& each) const {
    static_assert(most_vertices == 4);
    const auto* const vertices = reinterpret_cast<const VertexId*>(vertices_ + (number - first_) * stride_);
    for (std::size_t i = 0; i < most_vertices; ++i) each(vertices[std::min(i, last_)]);
  }

  void prefetch(std::size_t number) const {
    const std::byte* const force = forces_ + (number - first_) * stride_;
    __builtin_prefetch(force);
    __builtin_prefetch(force + stride_ - 1);
  }

 private:
  static constexpr std::size_t most_vertices = 4;

  const std::byte* forces_ = nullptr;
  const std::byte* vertices_ = nullptr;  ///< of the first force
  std::size_t first_ = 0, stride_ = 0, last_ = 0;
};

/// Finds out whether forces that are to fire together have a vertex in common.
class Claims {
 public:
  explicit Claims(std::size_t vertex_count = 0) : claimed_(vertex_count, 0) {}

  /// Forgets all claims.
  void clear() {
    if (++round_ != 0) return;
    std::fill(claimed_.begin(), claimed_.end(), 0);  // once in 2^32 rounds
    round_ = 1;
  }

  /// Claims the vertices of a force, unless one of them is taken; says whether it did.
  bool claim(const Shelf& shelf, std::size_t number) {
    bool taken = false;
    shelf.for_each_vertex(number, [&](VertexId v) { taken |= claimed_[v] == round_; });
    if (!taken) shelf.for_each_vertex(number, [&](VertexId v) { claimed_[v] = round_; });
    return !taken;
  }

 private:
  std::vector<std::uint32_t> claimed_;  ///< by vertex: the round in which it was claimed last
  std::uint32_t round_ = 0;
};

/// Clocks of forces of so many kinds.
template <std::size_t Kinds>
class OwnClocks {
 public:
  static constexpr std::size_t longest_row = 64;

  OwnClocks() = default;

  /// `counts`: how many forces a shelf has; `steps`: of all forces, by number.
  OwnClocks(const std::array<Shelf, Kinds>& shelves, const std::array<std::size_t, Kinds>& counts,
            const std::vector<double>& steps, std::size_t vertex_count, double now)
      : shelves_(shelves), claims_(vertex_count) {
    std::vector<std::uint32_t> kinds;
    for (std::uint32_t kind = 0; kind < Kinds; ++kind) kinds.insert(kinds.end(), counts[kind], kind);
    calendar_ = Calendar(steps, kinds, now);
  }

  bool empty() const { return calendar_.empty(); }
  /// Of the next force. Precondition: not empty.
  double next_time() const { return calendar_.front().time(); }

  /// Takes the next row: at least one force, at most `longest`, while is_due(). `prefetch`: is told vertices that will
  /// be needed.
  template <class IsDue, class Prefetch>
  void take_row(std::size_t longest, const IsDue& is_due, const Prefetch& prefetch) {
    sizes_ = {};
    claims_.clear();
    for (std::size_t size = 0; size < longest && is_due(); ++size) {
      const Calendar::Entry& entry = calendar_.front();
      const Shelf& shelf = shelves_[entry.kind];
      if (!claims_.claim(shelf, entry.event)) return;
      row_[entry.kind][sizes_[entry.kind]++] = {entry.time(), entry.step, entry.event - shelf.first()};
      look_ahead(prefetch);
      calendar_.advance();
    }
  }

  /// Those of the row that are of this kind.
  std::span<const DueForce> row(std::size_t kind) const { return {row_[kind].data(), sizes_[kind]}; }

 private:
  template <class Prefetch>
  void look_ahead(const Prefetch& prefetch) const {
    constexpr std::size_t far = 24, near = 12;
    if (calendar_.ahead() < far) return;
    const Calendar::Entry &later = calendar_.ahead(far), &soon = calendar_.ahead(near);
    shelves_[later.kind].prefetch(later.event);
    shelves_[soon.kind].for_each_vertex(soon.event, prefetch);
  }

  Calendar calendar_;
  std::array<Shelf, Kinds> shelves_;
  Claims claims_;
  std::array<std::array<DueForce, longest_row>, Kinds> row_{};
  std::array<std::size_t, Kinds> sizes_{};
};

}  // namespace noli::integrator
