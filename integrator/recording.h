// SPDX-License-Identifier: Apache-2.0
//
// Records breakpoints: one append-only stream in the order of events, sorted by vertex when the window is done (a
// buffer for each vertex would cost several times as much).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include <noli/mesh.h>
#include "integrator/force.h"
#include "trajectory/world_lines.h"

namespace noli::integrator {

/// The position of a vertex when an event changed its velocity, or at a window's end.
template <class S, int Dim>
struct Breakpoint {
  Vec<S, Dim> x;
  double t;
  VertexId vertex;
};

/// The breakpoints of one window. A vertex has at most one at a time.
template <class S, int Dim>
class Recording {
 public:
  /// Makes room for `count` more breakpoints.
  void reserve(std::size_t count) {
    if (stream_.size() - size_ < count) grow(count);
  }
  /// Appends a breakpoint if it is wanted. Precondition: there is room, wanted or not.
  void put(VertexId vertex, double t, const Vec<S, Dim>& x, bool wanted) {
    stream_[size_] = {x, t, vertex};
    size_ += wanted ? 1 : 0;
  }

  std::span<const Breakpoint<S, Dim>> stream() const { return {stream_.data(), size_}; }
  std::size_t size() const { return size_; }
  /// The time of the last breakpoint. Precondition: there is one.
  double last_time() const { return stream_[size_ - 1].t; }
  /// Forgets the breakpoints and keeps their room for the next window.
  void clear() { size_ = 0; }

 private:
  [[gnu::noinline]] void grow(std::size_t count) { stream_.resize(size_ + count + stream_.size() / 2); }

  std::vector<Breakpoint<S, Dim>> stream_;
  std::size_t size_ = 0;
};

/// Base of recorders that never end a window early.
struct Uncounted {
  static constexpr std::size_t size() { return 0; }
  static constexpr double last_time() { return 0; }
};

/// For runs without a recording.
struct NoRecording : Uncounted {
  void reserve(std::size_t) {}
  template <class X>
  void put(VertexId, double, const X&, bool) {}
};

/// Counts breakpoints like Recording without storing them, so that windows end at the same times.
class BreakpointCount {
 public:
  void reserve(std::size_t) {}
  template <class X>
  void put(VertexId, double t, const X&, bool wanted) {
    if (!wanted) return;
    ++size_;
    last_time_ = t;
  }
  std::size_t size() const { return size_; }
  double last_time() const { return last_time_; }

 private:
  std::size_t size_ = 0;
  double last_time_ = 0;
};

/// The world lines of a window: the stream sorted by vertex. Third coordinates of plane motion are zero. Throws
/// InputError when a vertex has fewer than two breakpoints, or one that is not finite.
template <int Dim>
WorldLines world_lines(const Recording<double, Dim>& recording, std::size_t vertex_count) {
  const auto stream = recording.stream();
  std::vector<std::size_t> offsets(vertex_count + 1, 0);
  for (const auto& b : stream) ++offsets[b.vertex + 1];
  for (std::size_t i = 0; i < vertex_count; ++i) offsets[i + 1] += offsets[i];
  std::vector<double> times(stream.size());
  std::vector<Position> positions(stream.size());
  std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
  for (const auto& b : stream) {
    const std::size_t i = next[b.vertex]++;
    times[i] = b.t;
    positions[i] = {b.x[0], b.x[1], Dim == 3 ? b.x[Dim - 1] : 0.0};
  }
  return WorldLines::from_breakpoints(std::move(offsets), std::move(times), std::move(positions), "window");
}

}  // namespace noli::integrator
