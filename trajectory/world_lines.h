// SPDX-License-Identifier: Apache-2.0
//
// World lines: for each vertex its breakpoints (t, x), joined linearly. The doubles are the trajectory.
//
// Notation
//   T0, T1        common first and last time of all vertices, T0 < T1
//   breakpoint    a time and the position at it; those of one vertex are in strictly ascending order of time
//   segment k     the piece between breakpoints k and k + 1 of a vertex, both included
//
// Storage: the breakpoints of all vertices in one array, vertex after vertex; those of v begin at offsets[v] and end
// before offsets[v + 1].
//
// Nothing here interpolates, as that would round (sample.h does). For exact results use the segments.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli {

class WorldLines {
 public:
  /// Two frames: every vertex has breakpoints at t = 0 and t = 1. Precondition: equal sizes, at least one vertex,
  /// finite positions.
  static WorldLines from_frames(std::span<const Position> x_t0, std::span<const Position> x_t1);

  /// Takes over breakpoints and checks them; errors name `source`. `offsets` has one entry more than there are
  /// vertices.
  /// Throws InputError with the vertex and its breakpoint: offsets that do not fit the arrays or descend, no vertices,
  /// fewer than two breakpoints, times that are not finite or not strictly ascending, a first or last time that differs
  /// from that of vertex 0, positions that are not finite.
  static WorldLines from_breakpoints(std::vector<std::size_t> offsets, std::vector<double> times,
                                     std::vector<Position> positions, const std::string& source);

  std::size_t vertex_count() const { return offsets_.size() - 1; }
  double first_time() const { return times_.front(); }
  double last_time() const { return times_.back(); }

  /// Times and positions of the breakpoints of a vertex, at least two.
  std::span<const double> times(VertexId v) const { return {times_.data() + offsets_[v], breakpoint_count(v)}; }
  std::span<const Position> positions(VertexId v) const {
    return {positions_.data() + offsets_[v], breakpoint_count(v)};
  }

  /// The segment k that contains t: at a breakpoint the one that begins there, at T1 the last. Precondition: T0 <= t <=
  /// T1.
  std::size_t segment_at(VertexId v, double t) const;

 private:
  WorldLines(std::vector<std::size_t> offsets, std::vector<double> times, std::vector<Position> positions)
      : offsets_(std::move(offsets)), times_(std::move(times)), positions_(std::move(positions)) {}
  std::size_t breakpoint_count(VertexId v) const { return offsets_[v + 1] - offsets_[v]; }

  std::vector<std::size_t> offsets_;
  std::vector<double> times_;
  std::vector<Position> positions_;
};

}  // namespace noli
