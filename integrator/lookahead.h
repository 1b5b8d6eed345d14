// SPDX-License-Identifier: Apache-2.0
//
// Where the forces of a calendar are in memory, by number, without a branch on their kind: with clocks of their own
// they fire in no order that a processor could foresee, and so does what is asked about them.
//
// Notation
//   number   of a force among all forces: those of one kind follow one another
//   shelf    the forces of one kind
//
// What this does not do: it is for forces that stay where they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "noli/integrator/force.h"

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

}  // namespace noli::integrator
