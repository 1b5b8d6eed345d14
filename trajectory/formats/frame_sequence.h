// SPDX-License-Identifier: Apache-2.0
//
// The steps between frames.
//
// Notation
//   step k     Motion::linear: from frame k to frame k + 1, n - 1 steps for n frames
//              Motion::constant: frame k stands still, n steps
//
// What this does not do: it reads nothing ahead and keeps nothing behind, so at most the positions of two frames are in
// memory, and what the source needs, which may read ahead (FrameReading::ahead).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trajectory/formats/frame_source.h"

namespace noli {

enum class Motion {
  linear,   ///< between successive frames each vertex moves at constant velocity
  constant  ///< each frame is a moment of its own
};

/// The steps of a sequence, in order:
///   FrameSequence sequence(source);
///   while (sequence.next()) use(sequence.mesh(), sequence.x_t0(), sequence.x_t1());
class FrameSequence {
 public:
  /// `source` has to outlive this. Throws InputError when there are fewer frames than a step needs (two, or one with
  /// Motion::constant). Reads nothing yet.
  explicit FrameSequence(FrameSource& source, Motion motion = Motion::linear);

  /// Nothing where it is only known when the last frame has been read.
  std::optional<std::size_t> step_count() const;

  /// Reads what the next step needs and moves to it; false when there is none. Throws InputError as the source and
  /// require_same_mesh do; the sequence must not be used any more then.
  bool next();

  /// Makes `step` the one to which next() moves. Precondition: it comes after the current one, of which there is one.
  /// Throws as next().
  void skip_to(std::size_t step);

  std::size_t frames_read() const { return frames_read_; }
  /// Number of the current step, from 0. This and all below: precondition: next() returned true.
  std::size_t step() const { return frames_read_ - (motion_ == Motion::linear ? 2 : 1); }
  const Mesh& mesh() const { return mesh_; }
  std::span<const Position> x_t0() const { return motion_ == Motion::linear ? x_t0_ : x_t1_; }
  std::span<const Position> x_t1() const { return x_t1_; }
  /// What messages call the frames.
  std::string name_t0() const { return source_.name(step()); }
  std::string name_t1() const { return source_.name(frames_read_ - 1); }

 private:
  bool read_next_frame();

  FrameSource& source_;
  Motion motion_;
  std::size_t frames_read_ = 0;
  Mesh mesh_;
  std::vector<Position> x_t0_, x_t1_;
};

}  // namespace noli
