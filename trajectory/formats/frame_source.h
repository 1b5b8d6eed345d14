// SPDX-License-Identifier: Apache-2.0
//
// Frames of one mesh in the order of time, whatever holds them: files, arrays, a stream.
//
//   auto source = open_frames({"motion.npz"});          // open_frames.h
//   FrameSequence sequence(*source, Motion::linear);    // frame_sequence.h
//
// Notation
//   frame k   k = 0, 1, ...; the mesh is that of frame 0, and all others must have the same
//
// A source keeps nothing behind: in memory are the frame that was read last and what makes reading it possible.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <noli/frames.h>
#include <noli/mesh.h>

namespace noli {

class FrameSource {
 public:
  FrameSource() = default;
  virtual ~FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// How many frames there are; nothing where that is only known when the last one has been read.
  virtual std::optional<std::size_t> count() const = 0;
  /// What messages call frame k: "cloth_3.ply", "motion.npz[3]".
  virtual std::string name(std::size_t k) const = 0;

  /// Looks for faults in what holds frame k before any frame is read, if that is possible. Throws InputError, Stopped.
  virtual void look_at(std::size_t k) = 0;
  /// Frame k; nothing behind the last. Frames are asked for in their order, perhaps with gaps; if can_begin_again(),
  /// also from an earlier one on.
  /// Throws InputError, also when it is no longer what was looked at; Stopped.
  virtual std::optional<Frame> read(std::size_t k) = 0;
  virtual bool can_begin_again() const = 0;
  /// Once all were looked at and one has been read: whether facts() and notes() stay as they are if no other is read.
  virtual bool may_skip() const { return false; }

  /// What was looked at, in the order of time: one per file.
  virtual const std::vector<FrameFacts>& facts() const = 0;
  /// Gives them away, which may be many; the source is of no more use.
  virtual std::vector<FrameFacts> take_facts() { return facts(); }
  /// Where bodies are in the mesh, once a frame has been read; empty where they have no names.
  virtual std::vector<FrameBody> bodies() const { return {}; }
  /// What to know of the numbers, a line each.
  virtual std::vector<std::string> notes() const = 0;
};

}  // namespace noli
